#pragma once

#include <glm/fwd.hpp>

namespace ergodome {

//! Coordinate system of a map's longitudes and latitudes: right ascension and declination J2000,
//! galactic, or ecliptic J2000.
enum class MapCoordinates { equatorial, galactic, ecliptic };

//! Mapping of an equirectangular map to the sky. The default is that of the built-in map.
struct MapLayout {
  MapCoordinates coordinates = MapCoordinates::equatorial;
  double middle_deg = 270.0;  //!< longitude in the middle of the image
  //! True: longitude increases to the right, as on a globe seen from outside, instead of to the
  //! left, as on the sky.
  bool mirrored = false;

  bool operator==(const MapLayout&) const = default;
};

//! Returns the rotation from the axes of a map's texels (direction_from_map(), after a mirrored map
//! was flipped from left to right) to equatorial J2000. Source: the galactic axes of the Hipparcos
//! catalog (ESA SP-1200, volume 1, equation 1.5.11), and the obliquity of the ecliptic of the IAU
//! 1976 system, 23° 26' 21.448".
glm::dmat3 equatorial_from_map(const MapLayout& layout);

}  // namespace ergodome
