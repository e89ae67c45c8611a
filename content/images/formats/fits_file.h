#pragma once

#include <span>
#include <string>

#include "content/images/image_library.h"

namespace ergodome {

//! Implements ImageLibrary::write_fits().
bool write_fits_file(const std::string& path, std::span<const FitsCard> primary, std::span<const FitsImage> images,
                     std::string& problem);

//! Implements ImageLibrary::whole_fits_text().
std::string text_of_whole_fits(const std::string& path, const std::string& name, int images);

}  // namespace ergodome
