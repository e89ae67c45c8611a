#pragma once

#include <span>
#include <string>

#include "content/tables/ray_table.h"
#include "render/passes/objects/object_rays.h"

namespace ergodome {

//! The head of the table that `trace --objects` writes.
inline constexpr const char* object_table_head = "id,object,triangle,weight_1,weight_2,x,y,z,delay\n";

//! A line for each ray that meets an object: which of the show's objects, which of its triangles, the weights of the triangle's second and third
//! corner, the place (pseudo-Cartesian [M], the camera at azimuth 0), coordinate time from there to the camera [M]. The rays share a camera. Throws
//! Error for rays that do not converge.
std::string object_lines(std::span<const RayRow> rows, const ObjectRays& objects, double tolerance);

}  // namespace ergodome
