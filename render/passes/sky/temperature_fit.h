#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "kernels/sky/blackbody.h"

namespace ergodome {

//! Finds the blackbody that a colour is nearest to: its correlated colour temperature.
//!
//! As the CIE defines it, by distance in (u, v) of 1960: bisection for the temperature whose isotherm goes through the colour (Robertson,
//! JOSA 58, 1968, with the blackbody table's own entries in place of his 31 lines), so a colour of the table gets its own temperature back.
class TemperatureFit {
 public:
  //! What colours are taken for at the least and most [K]. At the cold end the display shows no blackbody any more, and the ratios by which
  //! a shift multiplies have no bound; at the hot end are the hottest stars, and beyond it colour tells temperatures no longer apart.
  static constexpr double coldest_k = 1500.0;
  static constexpr double hottest_k = 40'000.0;

  //! `colours` in host memory; it is not kept.
  explicit TemperatureFit(const BlackbodyTable& colours);

  //! ln T [K] of a colour in linear sRGB, as bright as it may be; for black, that of the hottest.
  [[nodiscard]] float log_temperature(const glm::vec3& rgb) const;

  //! What a texel of that colour keeps (kernels/sky/cube_map.h): luminance times ln T.
  [[nodiscard]] float weighted_log_temperature(const glm::vec3& rgb) const;

 private:
  //! A point of the blackbodies' curve and the unit vector along it, to the hotter.
  struct Isotherm {
    double u;
    double v;
    double along_u;
    double along_v;
  };

  float first_;  //!< ln T of the first isotherm
  float step_;
  std::vector<Isotherm> isotherms_;
};

}  // namespace ergodome
