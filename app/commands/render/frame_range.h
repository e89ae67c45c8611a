#pragma once

#include <string>
#include <utility>

#include "app/playback/show_time.h"

namespace ergodome {

struct Show;

//! How a range of frames is written.
inline constexpr const char* frame_range_words =
    "FIRST:LAST, counted from 1; N is one frame, N: goes to the end, :N starts at frame 1";

//! How a time of a show is written.
inline constexpr const char* moment_words = "12s, 1.5s, 500ms, 2min or 1:30 (minutes:seconds)";

//! Parses "A:B", "A:", ":B" or "A", counted from 1, and returns the first and last frame, counted from 0; all `count` frames for "".
//! Throws UsageError for anything else and for frames beyond the show.
std::pair<int, int> frame_range(const std::string& text, int count);

//! Reads a time with a unit ("12s", "500ms", "2min") or as [HOURS:]MINUTES:SECONDS. Throws UsageError, naming `option`, for
//! anything else, a number without a unit included: that might be meant as a frame.
ShowTime moment_of(const std::string& option, const std::string& text);

//! Returns the first and last frame, counted from 0, that begin at or after `from` and before `to`; adjacent ranges
//! share no frame. An empty text stands for the beginning or the end of the show. Throws UsageError for times outside the show
//! and where no frame lies between them.
std::pair<int, int> frames_between(const std::string& from, const std::string& to, const Show& show);

}  // namespace ergodome
