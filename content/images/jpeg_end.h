#pragma once

#include <string_view>

namespace ergodome {

//! Whether the bytes of a JPEG go on to the marker that ends it. The library of JPEG fills what a torn file lacks with grey, and says so to nobody.
//! Source: ITU-T T.81, B.1.1 and B.2.
bool has_jpeg_end(std::string_view bytes);

}  // namespace ergodome
