#pragma once

#include <cstdint>
#include <string>

#include "content/images/formats/png_chunks.h"

namespace ergodome {

//! Returns what is wrong with the attributes of an OpenEXR file: one that claims more bytes than the file has, for which the library
//! would allocate all of them. Empty if nothing is, and for files of other formats. Source: OpenEXR, "File Layout".
std::string problem_of_exr(const NextBytes& next, std::uintmax_t file_bytes);

}  // namespace ergodome
