#pragma once

#include <string>
#include <utility>

#include "app/playback/clock/show_clock.h"

namespace ergodome {

struct Show;

//! Syntax of a range of frames, for help and messages.
inline constexpr const char* frame_range_words =
    "FIRST:LAST, counted from 1; N is one frame, N: goes to the end, :N starts at frame 1";

//! Syntax of a show time, for help and messages.
inline constexpr const char* moment_words = "12s, 1.5s, 500ms, 2min or 1:30 (minutes:seconds)";

//! Parses "A:B", "A:", ":B" or "A", counted from 1, and returns the first and last frame, counted
//! from 0. Returns all `count` frames for "". Throws UsageError for other text and for frames
//! beyond the show.
std::pair<int, int> frame_range(const std::string& text, int count);

//! Parses a time with a unit ("12s", "500ms", "2min") or [HOURS:]MINUTES:SECONDS. Throws
//! UsageError, naming `option`, for other text, including a number without a unit, which might be
//! meant as a frame.
ShowTime moment_of(const std::string& option, const std::string& text);

//! Returns the first and last frame, counted from 0, that begin at or after `from` and before `to`,
//! so adjacent ranges share no frame. An empty text stands for the beginning or the end of the
//! show. Throws UsageError for times outside the show, and if the range contains no frame.
std::pair<int, int> frames_between(const std::string& from, const std::string& to, const Show& show);

}  // namespace ergodome
