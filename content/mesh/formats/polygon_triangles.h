#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/core/vector3.h"

namespace ergodome {

//! Maximum number of corners of a face: triangulation takes time in proportion to its square.
inline constexpr std::size_t max_face_corners = 1024;

//! Triangulates a face of at least three corners: four corners along the shorter diagonal inside
//! the face, others by ear clipping (Meisters 1975), seen along the coordinate axis nearest to the
//! face's mean normal (Newell). Returns three corner indices per triangle, wound as the face is.
//! Correct for concave faces; the triangulation of a self-intersecting face is arbitrary.
std::vector<std::array<std::uint32_t, 3>> triangles_of_polygon(std::span<const Vector3<double>> corners);

}  // namespace ergodome
