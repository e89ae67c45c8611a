#pragma once

#include <vector>

#include "render/passes/objects/object_meshes.h"

namespace ergodome {

//! A show's object of which no ray can tell all, as it lies inside the horizon.
struct ObjectInHorizon {
  std::size_t object = 0;
  bool always_whole = false;  //!< all of it, at all times that were looked at: nobody ever sees it
  double first_s = 0.0;       //!< show time when some of it is inside for the first time
  double horizon_r = 0.0;     //!< then [M]
};

//! The traced objects of a show that come within its horizon, looked at where their own keys are and between them; polygons refuse such places by
//! themselves. `meshes`: those of load_meshes().
std::vector<ObjectInHorizon> objects_in_horizon(const Show& show, const ObjectMeshes& meshes);

//! A sentence about it for the person who made the show, with the line of its place.
std::string note_of(const Show& show, const ObjectInHorizon& inside);

}  // namespace ergodome
