#pragma once

#include <string>
#include <string_view>

namespace ergodome {

//! Returns true if the bytes of a JPEG reach its end marker. The JPEG library fills the missing
//! part of a truncated file with gray without an error. Source: ITU-T T.81, B.1.1 and B.2.
bool has_jpeg_end(std::string_view bytes);

//! Returns true if a JPEG is baseline and has no metadata except those of JFIF, and no comment.
bool is_plain_jpeg(std::string_view bytes);

//! Returns the ICC profile of a JPEG, joined from its APP2 segments; empty if it has none or parts
//! are missing. Source: ICC.1:2022, B.4.
std::string jpeg_icc_profile(std::string_view bytes);

}  // namespace ergodome
