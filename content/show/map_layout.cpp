#include "content/show/map_layout.h"

#include <cmath>
#include <glm/mat3x3.hpp>

#include "kernels/core/angles.h"

namespace ergodome {

namespace {

//! Returns a rotation around the z axis by an angle.
glm::dmat3 about_pole(double angle) {
  return {{std::cos(angle), std::sin(angle), 0.0}, {-std::sin(angle), std::cos(angle), 0.0}, {0.0, 0.0, 1.0}};
}

//! Returns the rotation from map coordinates to equatorial J2000: its columns are the axes of the
//! map coordinates.
glm::dmat3 equatorial_from(MapCoordinates coordinates) {
  constexpr double obliquity = (23.0 + 26.0 / 60.0 + 21.448 / 3600.0) * one_degree;
  switch (coordinates) {
    case MapCoordinates::galactic:
      return {{-0.0548755604, -0.8734370902, -0.4838350155},
              {0.4941094279, -0.4448296300, 0.7469822445},
              {-0.8676661490, -0.1980763734, 0.4559837762}};
    case MapCoordinates::ecliptic:
      return {{1.0, 0.0, 0.0},
              {0.0, std::cos(obliquity), std::sin(obliquity)},
              {0.0, -std::sin(obliquity), std::cos(obliquity)}};
    case MapCoordinates::equatorial:
      break;
  }
  return glm::dmat3(1.0);
}

}  // namespace

glm::dmat3 equatorial_from_map(const MapLayout& layout) {
  return equatorial_from(layout.coordinates) * about_pole((layout.middle_deg - MapLayout{}.middle_deg) * one_degree);
}

}  // namespace ergodome
