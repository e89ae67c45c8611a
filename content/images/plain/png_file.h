#pragma once

#include <memory>
#include <optional>
#include <string>

#include "content/images/image_library.h"

namespace ergodome {

//! Returns a writer of PNG files with 8 or 16 bits and three or four channels: the same chunks as
//! in the image library's files, in half the time and without loading that library. It writes
//! bytes of an ImageSample::whole_8 and numbers of a whole_16. Metadata other than texts are
//! ignored.
std::unique_ptr<ImageOutput> png_output();

//! Returns true if the PNG writer supports an image. It needs memory for all its bytes at once, so
//! larger images need the image library.
bool is_for_png_output(const ImagePlan& plan);

//! Returns whether a PNG file has this size and can be read to its last pixel; nothing if it is of
//! a kind that png_output() does not write.
std::optional<bool> is_whole_png(const std::string& path, int width, int height);

}  // namespace ergodome
