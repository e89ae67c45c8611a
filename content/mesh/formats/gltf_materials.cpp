#include "content/mesh/formats/gltf_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string_view>

#include "content/files/printable.h"
#include "content/mesh/mesh_builder.h"
#include "content/mesh/named_file.h"

namespace ergodome {

namespace {

constexpr std::string_view texture_transform = "KHR_texture_transform";
constexpr std::string_view webp_texture = "EXT_texture_webp";
constexpr std::string_view specular_glossiness = "KHR_materials_pbrSpecularGlossiness";

using tinygltf::ExtensionMap;
using tinygltf::Value;

//! A reference of a material to a texture.
struct TextureUse {
  int texture = -1;
  int set = 0;
  const Value* transform = nullptr;  //!< KHR_texture_transform
};

const Value* extension(const ExtensionMap& extensions, std::string_view name) {
  const auto found = extensions.find(std::string(name));
  return found != extensions.end() && found->second.IsObject() ? &found->second : nullptr;
}

std::optional<double> number_in(const Value& object, const std::string& key) {
  const Value& value = object.Has(key) ? object.Get(key) : Value();
  return value.IsNumber() ? std::optional(value.GetNumberAsDouble()) : std::nullopt;
}

std::array<double, 3> numbers_in(const Value& object, const std::string& key, std::array<double, 3> numbers) {
  const Value& list = object.Has(key) ? object.Get(key) : Value();
  for (std::size_t i = 0; list.IsArray() && i < std::min<std::size_t>(list.ArrayLen(), 3); ++i) {
    const Value& number = list.Get(static_cast<int>(i));
    numbers.at(i) = number.IsNumber() ? number.GetNumberAsDouble() : numbers.at(i);
  }
  return numbers;
}

//! The properties of a material that are drawn.
struct DrawnMaterial {
  std::array<double, 3> color = {1.0, 1.0, 1.0};
  double brightest = 1.0;
  double alpha = 1.0;
  TextureUse texture;
  bool glow_left_out = false;
};

TextureUse use_of(const Value& info) {
  TextureUse use;
  use.texture = static_cast<int>(number_in(info, "index").value_or(-1.0));
  use.set = static_cast<int>(number_in(info, "texCoord").value_or(0.0));
  if (info.Has("extensions") && info.Get("extensions").Has(std::string(texture_transform))) {
    use.transform = &info.Get("extensions").Get(std::string(texture_transform));
  }
  return use;
}

TextureUse use_of(const tinygltf::TextureInfo& info) {
  return {info.index, info.texCoord, extension(info.extensions, texture_transform)};
}

//! Returns the emitted light of a surface, multiplied by KHR_materials_emissive_strength.
std::array<double, 3> glow_of(const tinygltf::Material& material) {
  std::array<double, 3> glow{};
  const Value* const extended = extension(material.extensions, "KHR_materials_emissive_strength");
  const double strength = extended != nullptr ? number_in(*extended, "emissiveStrength").value_or(1.0) : 1.0;
  for (std::size_t i = 0; i < 3 && material.emissiveFactor.size() == 3; ++i) {
    glow.at(i) = strength * material.emissiveFactor[i];
  }
  return glow;
}

DrawnMaterial drawn_material(const tinygltf::Material& material) {
  DrawnMaterial drawn;
  const auto& base = material.pbrMetallicRoughness;
  for (std::size_t i = 0; i < 3 && base.baseColorFactor.size() == 4; ++i) {
    drawn.color.at(i) = base.baseColorFactor[i];
  }
  drawn.alpha = base.baseColorFactor.size() == 4 ? base.baseColorFactor[3] : 1.0;
  drawn.texture = use_of(base.baseColorTexture);
  if (const Value* const diffuse = extension(material.extensions, specular_glossiness)) {
    drawn.color = numbers_in(*diffuse, "diffuseFactor", {1.0, 1.0, 1.0});
    const Value& factor = diffuse->Has("diffuseFactor") ? diffuse->Get("diffuseFactor") : Value();
    const bool has_alpha = factor.IsArray() && factor.ArrayLen() == 4 && factor.Get(3).IsNumber();
    drawn.alpha = has_alpha ? factor.Get(3).GetNumberAsDouble() : 1.0;
    drawn.texture = diffuse->Has("diffuseTexture") ? use_of(diffuse->Get("diffuseTexture")) : TextureUse();
  }
  const std::array<double, 3> glow = glow_of(material);
  const bool glows = std::ranges::max(glow) > 0.0;
  const bool black = std::ranges::max(drawn.color) <= 0.0;
  if (glows && black) {
    // In a show, the color of a surface is that of the light that it emits. A black surface that
    // emits light is therefore drawn in the color of that light.
    drawn.color = glow;
    drawn.brightest = brightest_glow;
    drawn.texture = {material.emissiveTexture.index, material.emissiveTexture.texCoord,
                     extension(material.emissiveTexture.extensions, texture_transform)};
  }
  drawn.glow_left_out = glows && !black;
  return drawn;
}

TextureWrap wrap_of(int wrap) {
  return wrap == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE     ? TextureWrap::clamp
         : wrap == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? TextureWrap::mirror
                                                         : TextureWrap::repeat;
}

//! Returns the ending of an image's name from its first bytes, or else from its MIME type; empty
//! for unsupported formats.
std::string_view kind_of(const tinygltf::Image& image) {
  const std::string_view bytes(reinterpret_cast<const char*>(image.image.data()), image.image.size());
  if (bytes.starts_with("\x89PNG")) {
    return "png";
  }
  if (bytes.starts_with("\xFF\xD8\xFF")) {
    return "jpg";
  }
  if (bytes.starts_with("RIFF") && bytes.substr(0, 12).ends_with("WEBP")) {
    return "webp";
  }
  const bool other = bytes.starts_with("\xABKTX") || bytes.starts_with("DDS ");
  const std::string& declared = image.mimeType;
  return other                                                 ? ""
         : declared == "image/png"                             ? "png"
         : declared == "image/jpeg" || declared == "image/jpg" ? "jpg"
                                                               : "";
}

//! Returns an image that is embedded in the mesh's file, with a name for messages. Throws Error if
//! its format is not PNG, JPEG or WebP.
MeshImage image_inside(const GltfFile& file, const tinygltf::Image& image, int index) {
  const std::string_view kind = kind_of(image);
  if (kind.empty()) {
    throw Error(file.location, fmt::format("has image {} in an unsupported format", index),
                "export it with PNG, JPEG or WebP images");
  }
  // Few images of glTF files have names.
  const std::string name = image.name.empty() ? std::to_string(index) : printable(image.name.substr(0, 100));
  return {fmt::format("{}, its image {} ({}).{}", file.location, index, name, kind),
          std::make_shared<const std::string>(image.image.begin(), image.image.end()), ""};
}

//! Returns the index of a texture's image: its `source` if it has one, else that of
//! EXT_texture_webp; -1 if it has neither.
int source_of(const tinygltf::Texture& texture) {
  const Value* const webp = extension(texture.extensions, webp_texture);
  return texture.source >= 0 || webp == nullptr ? texture.source
                                                : static_cast<int>(number_in(*webp, "source").value_or(-1.0));
}

void put_picture(const GltfFile& file, const TextureUse& use, const std::filesystem::path& folder, MeshPart& part) {
  const tinygltf::Texture& texture = file.at(file.model.textures, use.texture, "texture");
  if (texture.sampler >= 0) {
    const tinygltf::Sampler& sampler = file.at(file.model.samplers, texture.sampler, "sampler");
    part.wrap_u = wrap_of(sampler.wrapS);
    part.wrap_v = wrap_of(sampler.wrapT);
  }
  const int source = source_of(texture);
  if (source < 0 && texture.extensions.empty()) {
    throw Error(file.location, fmt::format("has texture {} without an image", use.texture), "export the mesh again");
  }
  if (source < 0) {
    throw Error(file.location,
                fmt::format("has a texture in an unsupported format ({})",
                            printable(texture.extensions.begin()->first.substr(0, 100))),
                "export it with PNG, JPEG or WebP images");
  }
  const tinygltf::Image& image = file.at(file.model.images, source, "image");
  part.image = image.uri.empty() || !image.image.empty() ? image_inside(file, image, source)
                                                         : image_beside_mesh(image.uri, file.location, folder);
  part.image.of_gltf = true;
}

}  // namespace

bool is_known_gltf_extension(std::string_view name) {
  constexpr std::string_view known[] = {
      "KHR_mesh_quantization", texture_transform,       specular_glossiness,   "KHR_lights_punctual", "KHR_xmp",
      "KHR_xmp_json_ld",       "KHR_animation_pointer", "KHR_node_visibility", webp_texture};
  return std::ranges::find(known, name) != std::end(known) || name.starts_with("KHR_materials_");
}

bool gltf_alpha_counts(const tinygltf::Material& material) {
  return !material.alphaMode.empty() && material.alphaMode != "OPAQUE";
}

GltfTextureMapping gltf_texture_mapping(const GltfFile& file, int material) {
  GltfTextureMapping mapping;
  if (material < 0) {
    return mapping;
  }
  const TextureUse use = drawn_material(file.at(file.model.materials, material, "material")).texture;
  mapping.textured = use.texture >= 0;
  mapping.set = use.set;
  const Value* const transform = use.transform;
  if (transform == nullptr) {
    return mapping;
  }
  mapping.set = static_cast<int>(number_in(*transform, "texCoord").value_or(static_cast<double>(mapping.set)));
  const std::array<double, 3> offset = numbers_in(*transform, "offset", {0.0, 0.0, 0.0});
  const std::array<double, 3> scale = numbers_in(*transform, "scale", {1.0, 1.0, 1.0});
  const double angle = number_in(*transform, "rotation").value_or(0.0);
  // Translation * rotation * scale, with v pointing down.
  mapping.u = {scale[0] * std::cos(angle), scale[1] * std::sin(angle), offset[0]};
  mapping.v = {-scale[0] * std::sin(angle), scale[1] * std::cos(angle), offset[1]};
  return mapping;
}

MeshPart gltf_part(const GltfFile& file, int number, const std::filesystem::path& folder, MeshBuilder& builder) {
  MeshPart part;
  if (number < 0) {
    return part;
  }
  const tinygltf::Material& material = file.at(file.model.materials, number, "material");
  const DrawnMaterial drawn = drawn_material(material);
  std::ranges::transform(drawn.color, part.color.begin(),
                         [&](double light) { return static_cast<float>(std::clamp(light, 0.0, drawn.brightest)); });
  if (drawn.texture.texture >= 0) {
    put_picture(file, drawn.texture, folder, part);
  }
  part.image_alpha_counts = gltf_alpha_counts(material);
  part.transparent =
      part.image_alpha_counts && drawn.alpha < (material.alphaMode == "MASK" ? material.alphaCutoff : 1.0);
  if (part.transparent) {
    builder.remark("has transparent materials, which are drawn opaque");
  }
  if (drawn.glow_left_out) {
    builder.remark("has emissive materials; their emission (emissiveFactor) is not drawn");
  }
  for (const char* const name : {"KHR_materials_transmission", "KHR_materials_volume"}) {
    if (material.extensions.contains(name)) {
      builder.remark(fmt::format("has transmissive materials ({}), drawn opaque", name));
    }
  }
  return part;
}

}  // namespace ergodome
