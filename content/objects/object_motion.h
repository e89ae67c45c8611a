#pragma once

#include <algorithm>

#include "content/objects/object_settings.h"

namespace ergodome {

//! Where an object is and how it is turned: place = position + size · rows · (point of the mesh).
struct ObjectPlacement {
  Vector3<double> position;  //!< [M]
  double rows[3][3];         //!< a rotation
  Vector3<double> ahead = {0.0, 0.0,
                           0.0};  //!< on an orbit: from the hole's middle to where it is a quarter of it later [M]
  double rate = 0.0;              //!< angular velocity in the hole's time [1/M]; 0: it rests, or nobody knows

  bool operator==(const ObjectPlacement& other) const {
    return position.x == other.position.x && position.y == other.position.y && position.z == other.position.z &&
           std::equal(&rows[0][0], &rows[0][0] + 9, &other.rows[0][0]);
  }
};

//! Angular velocity along an orbit, in the hole's time [1/M]: 1 / (r^(3/2) + a cos i), below 0 backwards. It is that of matter in free fall in
//! the plane of the equator (Bardeen, Press & Teukolsky 1972, eq. 2.16), with the hole and against it, and about holes without spin; where an
//! inclined orbit about a spinning hole would leave its circle it is between the two.
double orbit_rate(const ObjectOrbit& orbit);

//! An object's placement at a show time.
ObjectPlacement placement_at(const ObjectSettings& object, double time_s);

}  // namespace ergodome
