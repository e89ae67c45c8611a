#include "app/frame_range.h"

#include <fmt/format.h>

#include "app/usage_error.h"
#include "kernels/core/error.h"

namespace ergodome {

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
      throw UsageError("--frames " + text, fmt::format("\"{}\" is no number of a frame", part),
                       fmt::format("write FIRST:LAST, for instance 1:{}", count));
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
    throw UsageError("--frames " + text, "ends before it begins", "write FIRST:LAST");
  }
  return {first - 1, last - 1};
}

}  // namespace ergodome
