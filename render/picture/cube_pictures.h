#pragma once

#include <array>
#include <string>

#include "kernels/projection/projection.h"
#include "render/picture/picture.h"

// Cuts a cube's picture into its faces.

namespace ergodome {

//! Returns the name of a face (as in OpenGL): px, nx, py, ny, pz or nz.
std::string cube_face_name(CubeFace face);

//! Cuts pictures of the faces out of a cube's strip, in the order of CubeFace. If `strips` holds
//! the strips of both eyes, each result holds that face for both. `projection` is that of one
//! strip. The first face gets the count of unresolved pixels.
std::array<Picture, cube_faces> cube_face_pictures(const Picture& strips, const Projection& projection);

}  // namespace ergodome
