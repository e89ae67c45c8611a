#pragma once

#include <array>
#include <string>

#include "kernels/projection/projection.h"
#include "render/frame/eye_renderer.h"

namespace ergodome {

//! Name of a face (OpenGL's): px, nx, py, ny, pz, nz.
std::string cube_face_name(CubeFace face);

//! The faces of a cube's strip as pictures of their own, in the order of CubeFace; where the strips of both eyes are in one picture, both
//! eyes' faces are. `projection` is that of one strip. Unresolved pixels are counted with the first face.
std::array<Picture, cube_faces> cube_face_pictures(const Picture& strips, const Projection& projection);

}  // namespace ergodome
