#pragma once

#include <span>

#include "app/pads/pad_raw.h"
#include "app/pads/pad_settings.h"

namespace ergodome {

//! What a deflection from 0 to 1 becomes.
double shaped(double deflection, const PadCurve& curve);

//! Shapes a vector's length and keeps its direction; no longer than 1.
void shape_radially(std::span<float> vector, const PadCurve& curve);

//! Turns a device's numbers into a PadState: calibration, mapping, inversion, dead zones and curves of a profile.
class PadResponse {
 public:
  PadResponse(const RawLayout& layout, const PadProfile& profile);

  //! `ignored` raw axes count as at rest. Triggers count as buttons, too: from half way down, until 0.4 (what they are in `before`).
  [[nodiscard]] PadState apply(const RawPad& raw, const std::bitset<most_raw_axes>& ignored,
                               const PadState& before) const;

  //! Where a raw axis is, before dead zones: -1 to 1, triggers 0 to 1; 0 where it moves nothing.
  [[nodiscard]] double position(std::size_t raw_axis, std::int32_t value) const;

 private:
  struct Mapped {
    PadAxis axis = PadAxis::left_x;
    bool moves = false;
    bool inverted = false;
    double least = 0.0;
    double centre = 0.0;
    double greatest = 1.0;
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
