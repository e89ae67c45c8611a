#pragma once

#include <array>
#include <filesystem>

#include "content/mesh/gltf/gltf_accessors.h"
#include "content/mesh/mesh_builder.h"

namespace ergodome {

//! How a material's picture lies on a surface.
struct GltfTexturePlace {
  bool textured = false;
  int set = 0;  //!< of texture coordinates
  //! u' and v' from (u, v, 1), rows of KHR_texture_transform's matrix.
  std::array<double, 3> u = {1.0, 0.0, 0.0};
  std::array<double, 3> v = {0.0, 1.0, 0.0};
};

//! Extensions of glTF that are read, or whose effect no show draws: gloss, clear coat, lights and the like. A file that
//! requires another one is refused.
bool is_known_gltf_extension(std::string_view name);

//! Whether a material's alpha has an effect: its mode is MASK or BLEND.
bool gltf_alpha_counts(const tinygltf::Material& material);

//! Returns how the picture of a material lies on its triangles; -1 stands for no material.
GltfTexturePlace gltf_texture_place(const GltfFile& file, int material);

//! Returns colour and picture of a material, without its triangles, and remarks on what of it is not drawn. Throws Error
//! where a picture is not there, or of no kind that is read.
MeshPart gltf_part(const GltfFile& file, int material, const std::filesystem::path& folder, MeshBuilder& builder);

}  // namespace ergodome
