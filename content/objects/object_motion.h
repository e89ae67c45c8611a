#pragma once

#include <algorithm>

#include "content/show/object_settings.h"

namespace ergodome {

//! Position and rotation of an object: point = position + size · rows · (point of the mesh).
struct ObjectPlacement {
  //! Position of the mesh's origin, pseudo-Cartesian, relative to the hole [M].
  Vector3<double> position;
  double rows[3][3];  //!< a rotation
  Vector3<double> ahead = {0.0, 0.0,
                           //! For an object on an orbit: its position a quarter turn later,
                           //! relative to the hole [M].
                           0.0};
  double rate = 0.0;  //!< angular velocity in the hole's time [1/M]; 0: at rest or unknown

  bool operator==(const ObjectPlacement& other) const {
    return position.x == other.position.x && position.y == other.position.y && position.z == other.position.z &&
           std::equal(&rows[0][0], &rows[0][0] + 9, &other.rows[0][0]);
  }
};

//! Returns the angular velocity along an orbit in the hole's time [1/M]: 1 / (r^(3/2) + a cos i),
//! or -1 / (r^(3/2) - a cos i) if it runs backward. It is that of free fall in the equatorial plane
//! (Bardeen, Press & Teukolsky 1972, eq. 2.16), prograde and retrograde, and around holes without
//! spin. An inclined orbit around a spinning hole would not stay a circle; its rate is
//! interpolated.
double orbit_rate(const ObjectOrbit& orbit);

//! Returns an object's placement at a show time.
ObjectPlacement placement_at(const ObjectSettings& object, double time_s);

}  // namespace ergodome
