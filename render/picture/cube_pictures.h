#pragma once

#include <array>
#include <string>

#include "kernels/projection/projection.h"
#include "render/picture/picture.h"

// Cuts a cube's picture into its faces.

namespace ergodome {

//! Returns the name of a face (as in OpenGL): px, nx, py, ny, pz or nz.
std::string cube_face_name(CubeFace face);

//! Cuts a cube's strip into pictures of its faces, in the order of CubeFace. If `strips` holds the
//! strips of both eyes, so does each face. `projection` is that of one strip. The first face gets
//! the count of unresolved pixels.
std::array<Picture, cube_faces> cube_face_pictures(const Picture& strips, const Projection& projection);

}  // namespace ergodome
