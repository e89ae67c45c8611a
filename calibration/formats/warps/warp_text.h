#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "calibration/warps/projector_view.h"
#include "calibration/warps/text_lines.h"
#include "kernels/core/error.h"

namespace ergodome {

//! Reads the lines of a text file with a warp; its messages name file and line.
class WarpText {
 public:
  WarpText(std::string_view text, std::string file) : lines_(text), file_(std::move(file)) {}

  //! Returns the next line that is not blank; nothing at the end.
  std::optional<std::string_view> next() { return lines_.next(); }

  //! Returns "FILE:LINE".
  [[nodiscard]] std::string location() const;
  [[nodiscard]] Error error(const std::string& problem, const std::string& remedy) const {
    return {location(), problem, remedy};
  }

  //! Parses a number between -10,000 and 10,000. `what` is its name in messages. Throws Error for
  //! anything else.
  [[nodiscard]] double number(std::string_view word, std::string_view what) const;
  //! Parses an integer from `minimum` to `maximum`. Throws Error for anything else.
  [[nodiscard]] long long whole(std::string_view word, std::string_view what, long long minimum,
                                long long maximum) const;

 private:
  TextLines lines_;
  std::string file_;
};

//! Returns the first 40 bytes of a text, printable, for a message.
std::string shown_of(std::string_view text);

//! Throws Error, which names `location`, unless a flat image can have this field of view.
void check_view(const Frustum& frustum, const std::string& location);

}  // namespace ergodome
