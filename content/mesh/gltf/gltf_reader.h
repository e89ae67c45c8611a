#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "content/mesh/triangle_mesh.h"

namespace ergodome {

//! Reads a glTF 2.0 file (https://registry.khronos.org/glTF/specs/2.0/) from its bytes, .gltf or, where `binary`, .glb: the
//! triangles of its default scene where their nodes place them, in the pose and with the morph weights that the file begins
//! with. Lines, points, cameras, lights and animations are left out. `folder` holds the files that it names; empty: there are
//! none. Throws Error where the file is malformed, too large, or requires an extension that is not read.
TriangleMesh read_gltf(std::string_view bytes, bool binary, const std::string& place,
                       const std::filesystem::path& folder);

}  // namespace ergodome
