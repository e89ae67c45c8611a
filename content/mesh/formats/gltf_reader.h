#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "content/mesh/triangle_mesh.h"

namespace ergodome {

//! Reads a glTF 2.0 file (https://registry.khronos.org/glTF/specs/2.0/) from its bytes, .gltf or,
//! if `binary`, .glb. The mesh has the triangles of the default scene as their nodes place them, in
//! the default pose and with the default morph weights. Ignores lines, points, cameras, lights and
//! animations. `folder` (may be empty) holds the files that it names. Throws Error if the file is
//! malformed, too large, or requires an unsupported extension.
TriangleMesh read_gltf(std::string_view bytes, bool binary, const std::string& location,
                       const std::filesystem::path& folder);

}  // namespace ergodome
