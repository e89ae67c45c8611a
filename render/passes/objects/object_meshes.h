#pragma once

#include <vector>

#include "content/mesh/triangle_mesh.h"
#include "content/show/show.h"
#include "render/passes/overlay/overlay_image.h"

namespace ergodome {

//! The meshes of a show's objects; several objects may share one.
struct ObjectMeshes {
  std::vector<TriangleMesh> meshes;
  std::vector<std::size_t> mesh_of;  //!< which of them each object has
};

//! Makes them, or reads them, each file once. Throws Error where one cannot be read.
ObjectMeshes load_meshes(const Show& show);

//! Reads the picture on a mesh's triangles, which is there. Throws Error like read_overlay_image; it names the mesh, too.
OverlayImage read_mesh_image(const MeshImage& image);

}  // namespace ergodome
