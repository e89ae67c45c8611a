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
  static constexpr double min_lit_part = 1e-3;

  //! Resets the state at the start of a new scene.
  void begin() { since_s_.reset(); }

  //! Records the lit fraction of the view, 0 to 1, at a time of a monotonic clock.
  void note(double now_s, double lit_part);

  //! Returns the seconds until the camera returns to the start, if the view has been black long
  //! enough for a hint.
  [[nodiscard]] std::optional<double> back_in_s(double now_s) const;

  //! Returns true once, when the camera has to return to the start.
  bool take_return(double now_s);

 private:
  std::optional<double> since_s_;  //!< when the view became black
};

//! Decides when to measure the lit part of a visitor's view: after the view has changed, at most
//! once a second.
class LightWatch {
 public:
  //! Starts a new scene: take() rejects measurements that were requested before it.
  void begin(double now_s) { began_s_ = now_s; }

  //! Returns whether to request a measurement now. `changed`: whether the view has just changed.
  [[nodiscard]] bool is_due(double now_s, bool changed) {
    constexpr double between_measurements_s = 1.0;
    changed_s_ = changed ? now_s : changed_s_;
    return changed_s_ > measured_s_ && now_s - measured_s_ >= between_measurements_s;
  }

  //! Records that the result of a measurement arrived, which was requested at `asked_s`. Returns
  //! whether the result is new and belongs to this scene.
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
