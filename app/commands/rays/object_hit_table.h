#pragma once

#include <span>
#include <string>

#include "content/tables/ray_table.h"
#include "render/passes/objects/object_rays.h"

namespace ergodome {

//! Header line of the table that `trace --objects` writes.
inline constexpr const char* object_table_head = "id,object,triangle,weight_1,weight_2,x,y,z,delay\n";

//! Returns a line for each ray that hits an object: index of the object in the show, index of its
//! triangle, barycentric weights of the triangle's second and third corners, the position of the
//! hit (pseudo-Cartesian [M], camera at azimuth 0), and the coordinate time from the hit to the
//! camera [M]. The rays share a camera. Throws Error for rays that do not converge.
std::string object_lines(const RayTable& table, std::span<const RayRow> rows, const ObjectRays& objects,
                         double tolerance);

}  // namespace ergodome
