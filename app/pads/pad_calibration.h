#pragma once

#include <string>
#include <vector>

#include "app/pads/pad_settings.h"
#include "app/pads/state/pad_state.h"

namespace ergodome {

//! Measures the range and center of each raw axis, and the sticks' dead zones, while the user moves
//! all sticks in circles, presses the triggers, and releases everything.
class PadCalibrator {
 public:
  //! Calibration is done when an axis has moved through at least half of its range, and then
  //! nothing has moved for `rest_s`.
  explicit PadCalibrator(RawLayout layout, double rest_s = 2.0);

  void take(const RawPad& pad, double now_s);
  [[nodiscard]] bool is_done(double now_s) const;

  //! Returns the profile with the measured values. Axes that moved through less than half of their
  //! range stay unchanged.
  [[nodiscard]] PadProfile applied_to(PadProfile profile) const;
  //! Returns the names of the unchanged axes.
  [[nodiscard]] std::vector<std::string> unmoved() const;

 private:
  //! The range of values of an axis.
  struct Range {
    std::int32_t minimum = 0;
    std::int32_t maximum = 0;

    void take(std::int32_t value);
    [[nodiscard]] double middle() const { return 0.5 * (static_cast<double>(minimum) + maximum); }
  };
  using Ranges = std::array<Range, max_raw_axes>;

  [[nodiscard]] bool is_moved(std::size_t axis) const;
  [[nodiscard]] double nominal(std::size_t axis) const;
  [[nodiscard]] double wander(std::size_t axis) const;
  void set_dead_zone(PadCurve& curve, PadAxis x, PadAxis y) const;

  RawLayout layout_;
  double rest_s_;
  bool begun_ = false;
  bool first_rest_over_ = false;
  double resting_since_s_ = 0.0;
  Ranges all_{};
  Ranges rest_{};        //!< ranges of values of the axes since anything last moved
  Ranges first_rest_{};  //!< ranges of values of the axes before anything first moved
};

}  // namespace ergodome
