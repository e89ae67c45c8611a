#pragma once

#include <string>
#include <string_view>

#include "content/images/formats/image_bytes.h"

namespace ergodome {

//! Returns what is wrong with the tags of an ICC profile: they lie outside it, or are shorter than
//! their type requires. Returns an empty text if nothing is. OpenImageIO reads texts from such tags
//! without these checks. Source: ICC.1:2022, 7.3 and 10.
std::string problem_of_icc_profile(std::string_view profile);

//! Checks the ICC profiles in an image file of any format as problem_of_icc_profile() does.
//! Radiance and OpenEXR files count as having none.
std::string problem_of_icc_profiles(const ImageBytes& file);

}  // namespace ergodome
