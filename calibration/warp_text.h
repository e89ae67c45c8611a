#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "calibration/orientation.h"
#include "calibration/text_lines.h"
#include "kernels/core/error.h"

namespace ergodome {

//! The lines of a warp in text, with messages that name file and line.
class WarpText {
 public:
  WarpText(std::string_view text, std::string file) : lines_(text), file_(std::move(file)) {}

  //! The next line that holds something; nothing at the end.
  std::optional<std::string_view> next() { return lines_.next(); }

  //! "FILE:LINE".
  [[nodiscard]] std::string place() const;
  [[nodiscard]] Error error(const std::string& problem, const std::string& remedy) const {
    return {place(), problem, remedy};
  }

  //! A word as a number of size 10,000 at the most; `what` says what it is.
  [[nodiscard]] double number(std::string_view word, std::string_view what) const;
  //! A word as a whole number from `least` to `most`.
  [[nodiscard]] long long whole(std::string_view word, std::string_view what, long long least, long long most) const;

 private:
  TextLines lines_;
  std::string file_;
};

//! At most 40 characters of a file, for a message.
std::string shown_of(std::string_view text);

//! Throws Error unless a field of view is one that a flat picture can have.
void check_view(const Frustum& frustum, const std::string& place);

}  // namespace ergodome
