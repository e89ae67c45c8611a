#pragma once

#include "content/objects/object_settings.h"

namespace ergodome {

//! Where an object is and how it is turned: place = position + size · rows · (point of the mesh).
struct ObjectPlacement {
  Vector3<double> position;  //!< [M]
  double rows[3][3];         //!< a rotation

  bool operator==(const ObjectPlacement&) const = default;
};

//! An object's placement at a show time.
ObjectPlacement placement_at(const ObjectSettings& object, double time_s);

}  // namespace ergodome
