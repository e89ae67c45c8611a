#pragma once

#include <cstdint>
#include <string>

#include "content/images/formats/png_chunks.h"

namespace ergodome {

//! Returns what is wrong with the attributes of an OpenEXR file. It finds attributes that claim
//! more bytes than the file has, all of which OpenEXR would allocate. Returns an empty text for a
//! correct file and for other formats. Source: OpenEXR, "File Layout".
std::string problem_of_exr(const NextBytes& next, std::uintmax_t file_bytes);

}  // namespace ergodome
