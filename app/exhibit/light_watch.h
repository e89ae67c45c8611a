#pragma once

namespace ergodome {

//! Decides when to measure the lit part of a visitor's view: after the view has changed, at most
//! once a second.
class LightWatch {
 public:
  //! Starts again for a new scene.
  void begin(double now_s) { began_s_ = now_s; }

  //! Returns whether to request a measurement now. `changed`: whether the view has just changed.
  [[nodiscard]] bool is_due(double now_s, bool changed) {
    constexpr double between_measurements_s = 1.0;
    changed_s_ = changed ? now_s : changed_s_;
    return changed_s_ > measured_s_ && now_s - measured_s_ >= between_measurements_s;
  }

  //! Takes the time when a measurement was requested. Returns whether it is a new one of this scene.
  [[nodiscard]] bool take(double asked_s) {
    const bool is_new = asked_s > measured_s_;
    measured_s_ = is_new ? asked_s : measured_s_;
    return is_new && asked_s >= began_s_;
  }

 private:
  double began_s_ = 0.0;
  double changed_s_ = 0.0;
  double measured_s_ = -1e300;  //!< when the last answer was requested
};

}  // namespace ergodome
