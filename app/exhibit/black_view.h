#pragma once

#include <optional>

namespace ergodome {

//! Decides when a visitor who sees only black gets a hint, and when the camera returns to the start
//! automatically.
class BlackView {
 public:
  static constexpr double hint_after_s = 3.0;
  static constexpr double return_after_s = 20.0;
  //! A frame counts as black if a smaller fraction of it is lit. A window has more lit pixels than
  //! this as soon as one star is in view.
  static constexpr double least_lit_part = 1e-3;

  //! Starts again for a new scene.
  void begin() { since_s_.reset(); }

  //! Takes the lit fraction of the view, 0 to 1, at a time of a monotonic clock.
  void note(double now_s, double lit_part);

  //! Returns the seconds until the camera returns to the start, if the view has been black long
  //! enough for a hint.
  [[nodiscard]] std::optional<double> back_in_s(double now_s) const;

  //! Returns true once, when the camera has to return to the start.
  bool take_return(double now_s);

 private:
  std::optional<double> since_s_;  //!< when the view became black
};

}  // namespace ergodome
