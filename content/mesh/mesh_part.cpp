#include "content/mesh/mesh_part.h"

#include <assimp/GltfMaterial.h>
#include <assimp/material.h>
#include <assimp/scene.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <memory>
#include <string_view>

#include "content/files/printable.h"
#include "content/mesh/named_file.h"

namespace ergodome {

namespace {

//! An image that the importer has found in the file itself: a PNG, a JPEG, or what else its kind says.
MeshImage image_inside(const aiTexture& from, int index, const std::string& place) {
  const std::string_view kind(from.achFormatHint, strnlen(from.achFormatHint, sizeof from.achFormatHint));
  const bool coded = from.mHeight == 0 && from.mWidth > 0 && from.pcData != nullptr;
  if (!coded || kind.empty() || !std::ranges::all_of(kind, [](unsigned char c) { return std::isalnum(c) != 0; })) {
    throw Error(place, "has an image inside the file that is neither PNG nor JPEG", "export it with such images");
  }
  // Few of a glTF have names.
  const std::string name = from.mFilename.length > 0 ? from.mFilename.C_Str() : std::to_string(index);
  // Of coded images the importer's width is their bytes.
  return {fmt::format("{}, its image {}.{}", place, name, kind),
          std::make_shared<const std::string>(reinterpret_cast<const char*>(from.pcData), from.mWidth), ""};
}

void remark(TriangleMesh& mesh, const std::string& sentence) {
  if (std::ranges::find(mesh.remarks, sentence) == mesh.remarks.end()) {
    mesh.remarks.push_back(sentence);
  }
}

}  // namespace

Error missing_file(const std::string& place, const std::string& name) {
  return {place, fmt::format("names \"{}\", which is not in its folder", name),
          "put it there, or take out the line that names it"};
}

MeshPart part_of(const aiScene& scene, const aiMesh& mesh, const std::string& place,
                 const std::filesystem::path& folder) {
  MeshPart part;
  if (mesh.mMaterialIndex >= scene.mNumMaterials) {
    return part;
  }
  const aiMaterial& material = *scene.mMaterials[mesh.mMaterialIndex];
  aiColor4D color(1.0F, 1.0F, 1.0F, 1.0F);
  if (material.Get(AI_MATKEY_COLOR_DIFFUSE, color) == aiReturn_SUCCESS) {
    const auto light = [](ai_real value) { return std::clamp(value, 0.0F, 1.0F); };
    part.color = {light(color.r), light(color.g), light(color.b)};
  }
  float opacity = 1.0F;
  material.Get(AI_MATKEY_OPACITY, opacity);
  aiString alpha_mode;
  const bool ignored = material.Get(AI_MATKEY_GLTF_ALPHAMODE, alpha_mode) == aiReturn_SUCCESS &&
                       std::string_view(alpha_mode.C_Str()) == "OPAQUE";
  part.transparent = !ignored && (opacity < 1.0F || color.a < 1.0F);
  aiString image;
  if (material.GetTexture(aiTextureType_DIFFUSE, 0, &image) != aiReturn_SUCCESS) {
    return part;
  }
  if (const auto [inside, index] = scene.GetEmbeddedTextureAndIndex(image.C_Str()); inside != nullptr) {
    part.image = image_inside(*inside, index, place);
    return part;
  }
  const std::filesystem::path named = std::filesystem::path(image.C_Str()).lexically_normal();
  if (named.string().starts_with("data:")) {
    throw Error(place, "has an image inside the file that cannot be read", "export it with PNG or JPEG images");
  }
  if (named.is_absolute() || named.empty() || *named.begin() == "..") {
    throw Error(place, fmt::format("names an image outside its folder (\"{}\")", named.string()),
                "keep images beside the mesh");
  }
  const std::filesystem::path there = file_of_mesh(folder, named.string());
  if (there.empty() && !folder.empty()) {
    throw missing_file(place, named.string());
  }
  part.image = {(there.empty() ? named : there).string(), nullptr, place};
  return part;
}

void remark_on_materials(std::vector<std::string> missing, TriangleMesh& mesh) {
  constexpr std::size_t most_named = 5;
  if (missing.empty()) {
    return;
  }
  const std::size_t more = missing.size() - std::min(missing.size(), most_named);
  missing.resize(missing.size() - more);
  mesh.remarks.push_back(fmt::format(
      "uses materials that no file which it names has (\"{}\"{}): their triangles are grey",
      printable(fmt::format("{}", fmt::join(missing, "\", \""))), more > 0 ? fmt::format(" and {} more", more) : ""));
}

void remark_on(const MeshPart& part, const aiMesh& from, TriangleMesh& mesh) {
  if (part.transparent) {
    remark(mesh, "has transparent materials, which are drawn opaque");
  }
  if (!part.image.empty() && !from.HasTextureCoords(0)) {
    remark(mesh, fmt::format("has triangles without texture coordinates, all of which show one corner of {}",
                             std::filesystem::path(part.image.name).filename().string()));
  }
}

}  // namespace ergodome
