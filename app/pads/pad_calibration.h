#pragma once

#include <string>
#include <vector>

#include "app/pads/pad_raw.h"
#include "app/pads/pad_settings.h"

namespace ergodome {

//! Measures a pad while a person moves all its sticks round and presses its triggers, and then lets go: the ends and the middle of each
//! raw axis, and how large the dead zones must be.
class PadCalibrator {
 public:
  //! It is done when nothing has moved for `rest_s` after something was moved.
  explicit PadCalibrator(RawLayout layout, double rest_s = 2.0);

  void take(const RawPad& pad, double now_s);
  [[nodiscard]] bool is_done(double now_s) const;

  //! The profile with what was measured. Axes that went through less than half of their range stay as they were.
  [[nodiscard]] PadProfile applied_to(PadProfile profile) const;
  //! Names of the axes that stay as they were.
  [[nodiscard]] std::vector<std::string> unmoved() const;

 private:
  //! From where to where an axis went.
  struct Range {
    std::int32_t least = 0;
    std::int32_t greatest = 0;

    void take(std::int32_t value);
    [[nodiscard]] double middle() const { return 0.5 * (static_cast<double>(least) + greatest); }
  };
  using Ranges = std::array<Range, most_raw_axes>;

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
  Ranges rest_{};        //!< since the last motion
  Ranges first_rest_{};  //!< before the first motion
};

}  // namespace ergodome
