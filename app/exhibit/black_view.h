#pragma once

#include <optional>

namespace ergodome {

//! Decides when a visitor who sees only black gets a hint, and when the camera returns to the start
//! automatically.
class BlackView {
 public:
  static constexpr double hint_after_s = 3.0;
  static constexpr double return_after_s = 20.0;
  //! A frame counts as black if less than this fraction of it is lit. A window has more lit pixels
  //! than this as soon as one star is in view.
  static constexpr double min_lit_part = 1e-3;

  //! Starts a new scene: the view does not count as black until the next note().
  void begin() { since_s_.reset(); }

  //! Records the lit fraction of the view, 0 to 1, at a time of a monotonic clock.
  void note(double now_s, double lit_part);

  //! Returns the seconds until the camera returns to the start, if the view has been black for at
  //! least hint_after_s; otherwise nothing.
  [[nodiscard]] std::optional<double> back_in_s(double now_s) const;

  //! Returns true if the view has been black for return_after_s, so that the camera has to return
  //! to the start. Then forgets when the view became black.
  bool take_return(double now_s);

 private:
  std::optional<double> since_s_;  //!< when the view became black; empty: it is not black
};

//! Decides when to measure the lit part of a visitor's view: after the view has changed, at most
//! once a second.
class LightWatch {
 public:
  //! Stores the start of a new scene: take() returns false for measurements requested before it.
  void begin(double now_s) { began_s_ = now_s; }

  //! Returns whether to request a measurement now: the view has changed since the request for the
  //! last result, which is at least a second ago. `changed`: whether the view has just changed.
  [[nodiscard]] bool is_due(double now_s, bool changed) {
    constexpr double between_measurements_s = 1.0;
    changed_s_ = changed ? now_s : changed_s_;
    return changed_s_ > measured_s_ && now_s - measured_s_ >= between_measurements_s;
  }

  //! Records that the result of a measurement arrived, which was requested at `asked_s`. Returns
  //! whether that is later than for all results before it, and not before the scene began.
  [[nodiscard]] bool take(double asked_s) {
    const bool is_new = asked_s > measured_s_;
    measured_s_ = is_new ? asked_s : measured_s_;
    return is_new && asked_s >= began_s_;
  }

 private:
  double began_s_ = 0.0;
  double changed_s_ = 0.0;
  double measured_s_ = -1e300;  //!< when the measurement with the last result was requested
};

}  // namespace ergodome
