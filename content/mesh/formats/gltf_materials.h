#pragma once

#include <array>
#include <filesystem>

#include "content/mesh/formats/gltf_accessors.h"
#include "content/mesh/mesh_builder.h"

namespace ergodome {

//! Mapping of a material's image to a surface.
struct GltfTextureMapping {
  bool textured = false;
  int set = 0;  //!< index of the set of texture coordinates that the image uses
  //! Coefficients of u' and v' from (u, v, 1): rows of the matrix of KHR_texture_transform.
  std::array<double, 3> u = {1.0, 0.0, 0.0};
  std::array<double, 3> v = {0.0, 1.0, 0.0};
};

//! Returns true for glTF extensions that are supported or can be ignored because shows do not draw
//! their effect, such as gloss, clear coat and lights. A file that requires another extension is
//! refused.
bool is_known_gltf_extension(std::string_view name);

//! Returns true if a material's alpha has an effect: its mode is MASK or BLEND.
bool gltf_alpha_counts(const tinygltf::Material& material);

//! Returns the mapping of a material's image to its triangles; material -1 means none.
GltfTextureMapping gltf_texture_mapping(const GltfFile& file, int material);

//! Returns the color and the image of a material, without its triangles. Adds remarks on features
//! that are not drawn. Throws Error if an image is missing or of an unsupported format.
MeshPart gltf_part(const GltfFile& file, int material, const std::filesystem::path& folder, MeshBuilder& builder);

}  // namespace ergodome
