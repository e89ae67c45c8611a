#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "kernels/sky/blackbody.h"

namespace ergodome {

//! Finds the blackbody closest to a color, which is the color's correlated color temperature.
//!
//! As defined by the CIE, closest in (u, v) of 1960. Bisects for the temperature whose isotherm
//! passes through the color (Robertson, JOSA 58, 1968, but with the entries of the blackbody table
//! instead of his 31 lines), so colors of the table get exactly their own temperature.
class TemperatureFit {
 public:
  //! Range of temperatures assigned to colors [K]. Below the coldest, displays cannot show
  //! blackbodies and the factors of a shift are unbounded. The hottest is that of the hottest
  //! stars; beyond it, color hardly depends on temperature.
  static constexpr double coldest_k = 1500.0;
  static constexpr double hottest_k = 40'000.0;

  //! `colours` must be in host memory; it is only used during the call.
  explicit TemperatureFit(const BlackbodyTable& colours);

  //! Returns ln T [K] of a color in linear sRGB, independent of its brightness; for black, that of
  //! the hottest blackbody.
  [[nodiscard]] float log_temperature(const glm::vec3& rgb) const;

  //! Returns the fourth number of a texel of this color (CubeMap).
  [[nodiscard]] float weighted_log_temperature(const glm::vec3& rgb) const;

 private:
  //! A point of the Planckian locus, and the unit tangent there, which points towards hotter
  //! temperatures.
  struct Isotherm {
    double u;
    double v;
    double along_u;
    double along_v;
  };

  float first_;  //!< ln T of the coldest blackbody in the table
  float step_;
  std::vector<Isotherm> isotherms_;
};

}  // namespace ergodome
