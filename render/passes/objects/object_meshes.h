#pragma once

#include <vector>

#include "content/mesh/triangle_mesh.h"
#include "content/show/show.h"
#include "render/passes/overlay/overlay_image.h"

namespace ergodome {

//! The meshes of a show's objects; several objects may share one.
struct ObjectMeshes {
  std::vector<TriangleMesh> meshes;
  std::vector<std::size_t> mesh_of;  //!< mesh index of each object
};

//! Generates the meshes, or reads them, each file once. Throws Error if one cannot be read.
ObjectMeshes load_meshes(const Show& show);

//! Reads the image on a mesh's triangles; `image` must not be empty. Throws Error like
//! read_stored_image; the message also names the mesh.
OverlayImage read_mesh_image(const MeshImage& image);

}  // namespace ergodome
