#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/core/vector3.h"

namespace ergodome {

//! The most corners that a face may have: cutting it takes their square.
inline constexpr std::size_t most_face_corners = 1024;

//! Cuts a face into triangles: by the shorter diagonal for four corners, else by ears (Meisters 1975), seen along the face's
//! mean normal (Newell). Returns three numbers of corners a triangle, wound as the face is; concave faces are right, faces that
//! cross themselves are covered somehow.
std::vector<std::array<std::uint32_t, 3>> triangles_of_polygon(std::span<const Vector3<double>> corners);

}  // namespace ergodome
