#pragma once

#include <string>
#include <utility>

namespace ergodome {

//! How a range of frames is written.
inline constexpr const char* frame_range_words =
    "FIRST:LAST, counted from 1; N alone is one frame, N: to the end, :N from the beginning";

//! First and last frame of a show with `count` of them, counted from 0, of "A:B", "A:", ":B" or "A", which count from 1; all of "". Throws Error for
//! what is none.
std::pair<int, int> frame_range(const std::string& text, int count);

}  // namespace ergodome
