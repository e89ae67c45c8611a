#pragma once

#include <span>

#include "app/pads/pad_settings.h"
#include "app/pads/state/pad_state.h"

namespace ergodome {

//! Applies a response curve to a deflection from 0 to 1.
double shaped(double deflection, const PadCurve& curve);

//! Applies a response curve to the length of a vector, limited to 1; keeps the direction.
void shape_radially(std::span<float> vector, const PadCurve& curve);

//! Converts raw values to a PadState: calibration, mapping, inversion, dead zones and curves of a
//! profile.
class PadResponse {
 public:
  PadResponse(const RawLayout& layout, const PadProfile& profile);

  //! Converts raw values. `ignored` raw axes count as at rest. Triggers also count as buttons:
  //! pressed from one half, released below 0.4; `before` is the last state.
  [[nodiscard]] PadState apply(const RawPad& raw, const std::bitset<max_raw_axes>& ignored,
                               const PadState& before) const;

  //! Returns the position of a raw axis before dead zones: -1 to 1, triggers 0 to 1; 0 if it
  //! controls nothing.
  [[nodiscard]] double position(std::size_t raw_axis, std::int32_t value) const;

 private:
  struct Mapped {
    PadAxis axis = PadAxis::left_x;
    bool moves = false;
    bool inverted = false;
    double minimum = 0.0;
    double centre = 0.0;
    double maximum = 1.0;
  };

  std::vector<Mapped> axes_;
  std::vector<std::optional<PadButton>> numbered_;
  std::bitset<pad_axis_count> inverted_;
  PadCurve left_stick_;
  PadCurve right_stick_;
  PadCurve triggers_;
  PadCurve puck_;
};

}  // namespace ergodome
