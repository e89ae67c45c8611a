#pragma once

#include <glm/fwd.hpp>

namespace ergodome {

//! What the longitudes and latitudes of a map of the sky are: J2000's right ascension and declination, the galaxy's, or the ecliptic's of J2000.
enum class MapCoordinates { equatorial, galactic, ecliptic };

//! How the picture of an equirectangular map lies on the sky. The usual one is that of the built-in map.
struct MapLayout {
  MapCoordinates coordinates = MapCoordinates::equatorial;
  double middle_deg = 270.0;  //!< longitude in the middle of the picture
  bool mirrored =
      false;  //!< longitudes rise to the right, as on a globe; else to the left, as the sky is seen from within

  bool operator==(const MapLayout&) const = default;
};

//! Rotation from the axes of a map's texels (direction_from_map, once a mirrored map's rows are turned round) to equatorial J2000.
//! Source: the galaxy's axes are those of the Hipparcos catalogue (ESA SP-1200, volume 1, equation 1.5.11), the obliquity of the ecliptic that of the
//! IAU's system of 1976, 23° 26' 21.448".
glm::dmat3 equatorial_from_map(const MapLayout& layout);

}  // namespace ergodome
