#include "app/commands/render/frame_range.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "app/cli/usage_error.h"
#include "content/show/show.h"

namespace ergodome {

namespace {

//! Parses a non-negative decimal number without sign, exponent or blanks. Returns nothing for other
//! text.
std::optional<double> decimal_of(std::string_view text) {
  double number = 0.0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number, std::chars_format::fixed);
  const bool plain = !text.empty() && text.front() >= '0' && text.front() <= '9';
  const bool whole = problem == std::errc() && end == text.data() + text.size();
  return plain && whole && std::isfinite(number) ? std::optional(number) : std::nullopt;
}

//! Parses "1:30" or "1:02:03.5" into seconds. All parts but the first must be below 60, and only
//! the last may have a fraction.
std::optional<double> seconds_of_clock(std::string_view text) {
  double seconds = 0.0;
  for (int parts = 1; parts <= 3; ++parts) {
    const std::size_t colon = text.find(':');
    const bool last = colon == std::string_view::npos;
    const std::optional<double> part = decimal_of(text.substr(0, colon));
    const bool fits = part && (parts == 1 || *part < 60.0) && (last || *part == std::floor(*part));
    if (!fits) {
      return std::nullopt;
    }
    seconds = 60.0 * seconds + *part;
    if (last) {
      return parts > 1 ? std::optional(seconds) : std::nullopt;
    }
    text.remove_prefix(colon + 1);
  }
  return std::nullopt;
}

std::optional<double> seconds_with_unit(std::string_view text) {
  struct Unit {
    std::string_view name;
    double seconds;
  };
  // "ms" comes before "s" because it also ends with "s".
  for (const Unit& unit : {Unit{"ms", 1e-3}, Unit{"s", 1.0}, Unit{"min", 60.0}}) {
    if (text.ends_with(unit.name)) {
      const std::optional<double> number = decimal_of(text.substr(0, text.size() - unit.name.size()));
      return number ? std::optional(*number * unit.seconds) : std::nullopt;
    }
  }
  return std::nullopt;
}

//! Returns the number of frames that begin before a time.
std::int64_t frames_before(ShowTime time, FrameRate rate) {
  return time.count() > 0 ? frame_at(time - ShowTime(1), rate) + 1 : 0;
}

}  // namespace

std::pair<int, int> frame_range(const std::string& text, int count) {
  if (text.empty()) {
    return {0, count - 1};
  }
  const auto number = [&](const std::string& part, int otherwise) {
    if (part.empty()) {
      return otherwise;
    }
    std::size_t used = 0;
    int value = 0;
    try {
      value = std::stoi(part, &used);
    } catch (const std::exception&) {
      used = 0;
    }
    if (used != part.size()) {
      throw UsageError("--frames " + text, fmt::format("\"{}\" is not a frame number", part),
                       fmt::format("write FIRST:LAST, for instance 1:{}; use --from and --to for times", count));
    }
    if (value < 1 || value > count) {
      throw UsageError("--frames " + text, fmt::format("\"{}\" is not a frame of this show", part),
                       fmt::format("choose from 1:{}", count));
    }
    return value;
  };
  const std::size_t colon = text.find(':');
  const int first = number(text.substr(0, colon), 1);
  const int last = colon == std::string::npos ? first : number(text.substr(colon + 1), count);
  if (last < first) {
    throw UsageError("--frames " + text, "ends before it begins", "write the smaller number first");
  }
  return {first - 1, last - 1};
}

ShowTime moment_of(const std::string& option, const std::string& text) {
  const std::optional<double> seconds =
      text.find(':') != std::string::npos ? seconds_of_clock(text) : seconds_with_unit(text);
  if (seconds) {
    return show_time(*seconds);
  }
  const bool bare = decimal_of(text).has_value();
  throw UsageError(option + " " + text, bare ? "is a number without a unit" : "is not a time",
                   bare ? fmt::format("write {}s for a time; use --frames for frame numbers", text)
                        : fmt::format("write {}", moment_words));
}

std::pair<int, int> frames_between(const std::string& from, const std::string& to, const Show& show) {
  const int count = frame_count(show);
  const FrameRate rate = frame_rate_of(show.frame_rate_hz);
  const ShowTime end = std::max(show_time(show.duration_s), time_of_frame(count, rate));
  const auto within = [&](const char* option, const std::string& text) {
    const ShowTime time = moment_of(option, text);
    if (time > end) {
      throw UsageError(fmt::format("{} {}", option, text),
                       fmt::format("is after the end of the show at {:.10g} s", show.duration_s),
                       fmt::format("choose a time from 0s to {:.10g}s", show.duration_s));
    }
    return time;
  };
  const std::int64_t first = from.empty() ? 0 : frames_before(within("--from", from), rate);
  const std::int64_t after =
      to.empty() ? count : std::min<std::int64_t>(frames_before(within("--to", to), rate), count);
  if (first >= after) {
    const std::string words = (from.empty() ? "" : "--from " + from) + (from.empty() || to.empty() ? "" : " ") +
                              (to.empty() ? "" : "--to " + to);
    throw UsageError(words, "contains no frame",
                     fmt::format("choose an earlier --from or a later --to; a frame begins every {:.3g} s",
                                 1.0 / show.frame_rate_hz));
  }
  return {static_cast<int>(first), static_cast<int>(after) - 1};
}

}  // namespace ergodome
