#pragma once

#include <vector>

#include "render/passes/objects/object_meshes.h"

namespace ergodome {

//! An object of a show that lies partly inside the horizon, where rays cannot reach it.
struct ObjectInHorizon {
  std::size_t object = 0;
  bool always_whole = false;  //!< entirely inside at all sampled times, so never visible
  double first_s = 0.0;       //!< first sampled show time at which part of it is inside
  double horizon_r = 0.0;     //!< horizon radius at that time [M]
};

//! Finds the traced objects of a show that enter the horizon, sampling times at and between their
//! keys. (Polygon objects throw an Error at such positions instead.) `meshes`: those of
//! load_meshes().
std::vector<ObjectInHorizon> objects_in_horizon(const Show& show, const ObjectMeshes& meshes);

//! Returns a message about such an object for the author of the show, with the line of its
//! position.
std::string note_of(const Show& show, const ObjectInHorizon& inside);

}  // namespace ergodome
