#pragma once

#include <cstdint>

#include "kernels/core/host_device.h"
#include "kernels/core/vector3.h"

namespace ergodome {

//! A star as it is drawn.
struct FieldStar {
  Vector3<double> direction;  //!< unit vector in the hole's sky axes (z: spin axis)
  float log_temperature;      //!< ln of its temperature [K]
  float illuminance;          //!< illuminance without lensing [lx]
  float radius;               //!< angular radius of its disk [rad]
  std::uint32_t number;       //!< number in the catalogue
};

//! Classes of stars, equally wide in ln T [K]. They span the temperatures that colors of stars
//! indicate, and a little more.
inline constexpr int star_classes = 16;
inline constexpr float log_coldest_class = 7.38F;
inline constexpr float log_hottest_class = 10.4F;
inline constexpr float star_class_width = (log_hottest_class - log_coldest_class) / star_classes;

//! Maximum factor by which a frequency shift changes the luminance of stars of each class, and its
//! natural logarithm.
struct ShiftGain {
  float gain[star_classes];
  float log_gain[star_classes];
};

inline namespace ERGO_TARGET {

//! Returns the class of a star: the first or the last if its temperature is outside all classes.
//! `log_temperature`: ln T [K].
ERGO_HD int star_class(float log_temperature) {
  const int position = static_cast<int>((log_temperature - log_coldest_class) / star_class_width);
  return position < 0 ? 0 : position < star_classes ? position : star_classes - 1;
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
