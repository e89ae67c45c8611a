#include "content/mesh/formats/obj_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "content/files/printable.h"
#include "content/files/whole_file.h"
#include "content/mesh/formats/obj_lines.h"
#include "content/mesh/formats/obj_statements.h"
#include "content/mesh/formats/polygon_triangles.h"
#include "content/mesh/mesh_builder.h"
#include "content/mesh/named_file.h"

namespace ergodome {

namespace {

//! The mesh that the statements of a file describe.
class ObjMesh {
 public:
  ObjMesh(const std::string& location, const std::filesystem::path& folder, std::string_view text)
      : builder_(location), folder_(folder), file_(read_obj_statements(text, folder_, builder_)) {}

  TriangleMesh build() {
    sum_normals();
    for (const ObjFace& face : file_.faces) {
      build_face(face);
    }
    remark_on_statements();
    remark_on_materials();
    return builder_.take([this](int material) { return part_of(material); });
  }

 private:
  void build_face(const ObjFace& face);
  void sum_normals();
  [[nodiscard]] Vector3<double> position(const ObjFace& face, std::size_t corner) const;
  [[nodiscard]] Vector3<double> face_normal(const ObjFace& face) const;
  [[nodiscard]] Vector3<double> normal_of(const ObjFace& face, const ObjCorner& corner) const;
  [[nodiscard]] const ObjMaterial* material_of(int number) const;
  [[nodiscard]] MeshPart part_of(int material);
  void remark_on_statements();
  void remark_on_materials();

  MeshBuilder builder_;
  std::filesystem::path folder_;
  ObjStatements file_;
  //! For each smoothing group at each vertex: the sum of face_normal(), which is weighted by area,
  //! over its faces.
  std::unordered_map<std::uint64_t, Vector3<double>> sums_;
};

Vector3<double> ObjMesh::position(const ObjFace& face, std::size_t corner) const {
  return file_.vertices[static_cast<std::size_t>(file_.corners[face.first_corner + corner].vertex)].position;
}

//! Returns a vector of twice the face's area, along its normal.
Vector3<double> ObjMesh::face_normal(const ObjFace& face) const {
  Vector3<double> sum = {0.0, 0.0, 0.0};
  for (std::size_t i = 1; i + 1 < face.corners; ++i) {
    sum = sum + cross(position(face, i) - position(face, 0), position(face, i + 1) - position(face, 0));
  }
  return sum;
}

std::uint64_t group_key(const ObjFace& face, const ObjCorner& corner) {
  return (static_cast<std::uint64_t>(face.smoothing_group) << 32U) ^ static_cast<std::uint64_t>(corner.vertex);
}

void ObjMesh::sum_normals() {
  for (const ObjFace& face : file_.faces) {
    for (std::size_t i = 0; i < face.corners && face.smoothing_group > 0; ++i) {
      const ObjCorner& corner = file_.corners[face.first_corner + i];
      if (corner.normal < 0) {
        Vector3<double>& sum = sums_.try_emplace(group_key(face, corner), Vector3<double>{0.0, 0.0, 0.0}).first->second;
        sum = sum + face_normal(face);
      }
    }
  }
}

//! Returns the normal of a corner. Returns zero if neither the file nor the faces define one.
//! Later, repair_normals() replaces zeros.
Vector3<double> ObjMesh::normal_of(const ObjFace& face, const ObjCorner& corner) const {
  if (corner.normal >= 0) {
    return file_.normals[static_cast<std::size_t>(corner.normal)];
  }
  const Vector3<double> sum = face.smoothing_group > 0 ? sums_.at(group_key(face, corner)) : face_normal(face);
  const double length = std::sqrt(dot(sum, sum));
  return length > 0.0 ? (1.0 / length) * sum : Vector3<double>{0.0, 0.0, 0.0};
}

void ObjMesh::build_face(const ObjFace& face) {
  throw_if_reading_stopped(builder_.location());
  std::vector<Vector3<double>> positions;
  positions.reserve(face.corners);
  for (std::size_t i = 0; i < face.corners; ++i) {
    positions.push_back(position(face, i));
  }
  const ObjMaterial* const material = material_of(face.material);
  const ObjTexture placed = material != nullptr ? (material->diffuse_texture.name.empty() ? material->emission_texture
                                                                                          : material->diffuse_texture)
                                                : ObjTexture();
  const auto vertex_of = [&](std::uint32_t i) {
    const ObjCorner& corner = file_.corners[face.first_corner + i];
    const ObjVertex& from = file_.vertices[static_cast<std::size_t>(corner.vertex)];
    const Vector3<double> normal = normal_of(face, corner);
    const std::array<float, 2> texture = corner.texture >= 0 ? file_.textures[static_cast<std::size_t>(corner.texture)]
                                                             : std::array<float, 2>{0.0F, 0.0F};
    const auto on_picture = [&](std::size_t axis) {
      return static_cast<float>(placed.scale.at(axis) * static_cast<double>(texture.at(axis)) + placed.offset.at(axis));
    };
    return builder_.add_vertex(
        {{static_cast<float>(positions[i].x), static_cast<float>(positions[i].y), static_cast<float>(positions[i].z)},
         {static_cast<float>(normal.x), static_cast<float>(normal.y), static_cast<float>(normal.z)},
         {on_picture(0), on_picture(1)},
         {from.color[0], from.color[1], from.color[2]}});
  };
  for (const auto& [a, b, c] : triangles_of_polygon(positions)) {
    const std::uint32_t first = vertex_of(a);
    const std::uint32_t second = vertex_of(b);
    builder_.add_triangle(face.material, first, second, vertex_of(c));
  }
  const bool plain = file_.corners[face.first_corner].texture < 0;
  if (plain && !placed.name.empty()) {
    builder_.remark(fmt::format("has triangles without texture coordinates; they show a single texel of {}",
                                std::filesystem::path(placed.name).filename().string()));
  }
}

const ObjMaterial* ObjMesh::material_of(int number) const {
  const auto found = number == no_obj_material ? file_.materials.end()
                                               : file_.materials.find(file_.names[static_cast<std::size_t>(number)]);
  return found == file_.materials.end() ? nullptr : &found->second;
}

//! Returns the MeshPart for a material. If a material emits light and has a black diffuse color
//! without an image, the part has the color and image of the emitted light, because surfaces of a
//! show emit light.
MeshPart ObjMesh::part_of(int number) {
  MeshPart part;
  const ObjMaterial* const material = material_of(number);
  if (material == nullptr) {
    part.color = file_.has_colors ? std::array<float, 3>{1.0F, 1.0F, 1.0F} : ObjMaterial().diffuse;
    return part;
  }
  const auto is_black = [](const std::array<float, 3>& c) { return std::ranges::max(c) <= 0.0F; };
  const bool glows = !is_black(material->emission) || !material->emission_texture.name.empty();
  const bool by_glow = glows && material->diffuse_texture.name.empty() && is_black(material->diffuse);
  const ObjTexture& texture = by_glow ? material->emission_texture : material->diffuse_texture;
  // An image without a color in the material is multiplied by white.
  const bool white = !texture.name.empty() && !(by_glow ? !is_black(material->emission) : material->has_diffuse);
  part.color = white ? std::array<float, 3>{1.0F, 1.0F, 1.0F} : by_glow ? material->emission : material->diffuse;
  const float brightest = by_glow ? brightest_glow : 1.0F;
  std::ranges::transform(part.color, part.color.begin(),
                         [&](float light) { return std::clamp(light, 0.0F, brightest); });
  if (!by_glow && !texture.name.empty() && is_black(part.color)) {
    builder_.remark("has textures that are black because their material color is black (Kd 0 0 0)");
  }
  if (material->diffuse_unread) {
    builder_.remark("has a material whose color (Kd) is not three numbers with decimal points; the color is ignored");
  }
  if (glows && !by_glow) {
    builder_.remark("has emissive materials; their emission (Ke) is not drawn");
  }
  part.transparent = material->transparent;
  if (part.transparent) {
    builder_.remark("has transparent materials, which are drawn opaque");
  }
  part.wrap_u = part.wrap_v = texture.clamp ? TextureWrap::clamp : TextureWrap::repeat;
  if (!texture.name.empty()) {
    part.image = image_beside_mesh(texture.name, builder_.location(), folder_);
  }
  return part;
}

void ObjMesh::remark_on_statements() {
  if (file_.has_lines) {
    builder_.remark("has points or lines, which are not drawn");
  }
  if (file_.has_free_forms) {
    builder_.remark("has free-form curves or surfaces (curv, surf), which are not drawn");
  }
}

void ObjMesh::remark_on_materials() {
  constexpr std::size_t max_named = 5;
  std::vector<std::string> missing;
  for (const std::string& name : file_.names) {
    if (!folder_.empty() && !file_.materials.contains(name)) {
      missing.push_back(printable(name.substr(0, 100)));
    }
  }
  if (missing.empty()) {
    return;
  }
  const std::size_t named = std::min(missing.size(), max_named);
  const std::size_t more = missing.size() - named;
  missing.resize(named);
  builder_.remark(fmt::format("uses materials that no material file defines (\"{}\"{}); their triangles are gray",
                              fmt::join(missing, "\", \""), more > 0 ? fmt::format(" and {} more", more) : ""));
}

}  // namespace

TriangleMesh read_obj(std::string_view text, const std::string& location, const std::filesystem::path& folder) {
  return ObjMesh(location, folder, text).build();
}

std::vector<std::filesystem::path> files_of_obj(std::string_view text, const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  const auto add = [&](const std::string& name) {
    constexpr std::size_t max_files = 1000;
    const std::filesystem::path file = name.empty() ? std::filesystem::path() : file_of_mesh(folder, name);
    if (!file.empty() && files.size() < max_files && std::ranges::find(files, file) == files.end()) {
      files.push_back(file);
    }
  };
  for (ObjLines lines(text); lines.next();) {
    if (lines.keyword() == "mtllib") {
      std::ranges::for_each(library_names(lines.rest(), folder), add);
    }
  }
  for (const std::filesystem::path& library : std::vector<std::filesystem::path>(files)) {
    ObjMaterials materials;
    add_obj_materials(read_whole_file(library, largest_obj_library_bytes, obj_library_remedy), materials);
    for (const auto& [name, material] : materials) {
      add(material.diffuse_texture.name);
      add(material.emission_texture.name);
    }
  }
  return files;
}

}  // namespace ergodome
