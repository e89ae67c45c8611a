#pragma once

#include <string>
#include <string_view>

namespace ergodome {

//! Returns whether the bytes of a JPEG reach the marker that ends it. The JPEG library fills what is
//! missing of a truncated file with gray, without an error. Source: ITU-T T.81, B.1.1 and B.2.
bool has_jpeg_end(std::string_view bytes);

//! Returns the ICC profile of a JPEG, joined from its APP2 segments; empty if it has none, or not all
//! parts. Source: ICC.1:2022, B.4.
std::string jpeg_icc_profile(std::string_view bytes);

}  // namespace ergodome
