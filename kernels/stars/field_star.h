#pragma once

#include <cstdint>

#include "kernels/core/host_device.h"
#include "kernels/core/vector3.h"

namespace ergodome {

//! A star as it is drawn.
struct FieldStar {
  Vector3<double> direction;  //!< unit vector in the hole's sky axes (z: spin axis)
  float log_temperature;      //!< ln of its temperature [K]
  float illuminance;          //!< in empty space [lx]
  float radius;               //!< angle that its disk spans, half [rad]
  std::uint32_t number;       //!< as the catalogue counts
};

//! Classes of stars by their temperature, equally wide in its logarithm, from ln T [K] of the coldest to the hottest star that colours
//! tell of, and a little beyond.
inline constexpr int star_classes = 16;
inline constexpr float log_coldest_class = 7.38F;
inline constexpr float log_hottest_class = 10.4F;
inline constexpr float star_class_width = (log_hottest_class - log_coldest_class) / star_classes;

//! What stars gain in luminance by a shift of their light, by their class.
struct ShiftGain {
  float gain[star_classes];
  float log_gain[star_classes];
};

inline namespace ERGO_TARGET {

//! The class of a star; `log_temperature`: ln T [K].
ERGO_HD int star_class(float log_temperature) {
  const int place = static_cast<int>((log_temperature - log_coldest_class) / star_class_width);
  return place < 0 ? 0 : place < star_classes ? place : star_classes - 1;
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
