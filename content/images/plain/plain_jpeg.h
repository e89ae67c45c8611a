#pragma once

#include <memory>
#include <string>

#include "content/images/image_library.h"

namespace ergodome {

//! Opens a JPEG file whose pixels need no interpretation: baseline, 8 bits, three channels, no
//! metadata except JFIF, so sRGB and upright. Returns null for all other files, which need the
//! image library. The pixels are those of the image library, which takes a quarter of a second to
//! load.
std::unique_ptr<ImageInput> open_plain_jpeg(const std::string& path);

}  // namespace ergodome
