#include "content/mesh/formats/obj_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <unordered_map>

#include "content/files/printable.h"
#include "content/files/whole_file.h"
#include "content/mesh/formats/obj_lines.h"
#include "content/mesh/formats/obj_materials.h"
#include "content/mesh/formats/polygon_triangles.h"
#include "content/mesh/mesh_builder.h"
#include "content/mesh/named_file.h"
#include "kernels/image/color_map.h"

namespace ergodome {

namespace {

constexpr const char* face_remedy = "export the mesh again";
//! Maximum size of a material library, which has only some lines per material.
constexpr std::size_t largest_library_bytes = std::size_t{64} << 20U;
//! Maximum work of triangulation: the sum over all faces of the squared number of corners.
constexpr double max_cutting_work = 1e9;
constexpr int no_material = -1;

//! Indices of a face's corner, from 0; -1 for none.
struct Corner {
  std::int64_t vertex;
  std::int64_t texture;
  std::int64_t normal;
};

struct Face {
  std::size_t first_corner;
  std::uint32_t corners;
  int material;
  long smoothing_group;
  long line;
};

struct Vertex {
  Vector3<double> position;
  //! Color of the vertex as in the file, later converted to linear light.
  std::array<float, 3> color;
  bool has_color;
};

class ObjReader {
 public:
  ObjReader(const std::string& location, const std::filesystem::path& folder) : builder_(location), folder_(folder) {}

  TriangleMesh read(std::string_view text) {
    for (ObjLines lines(text); lines.next();) {
      line_ = lines.line();
      throw_if_reading_stopped(builder_.location());
      read_statement(lines.keyword(), lines.rest());
    }
    check_end(text);
    if (!smooth_by_groups_) {
      std::ranges::for_each(faces_, [](Face& face) { face.smoothing_group = 1; });
    }
    build();
    remark_on_statements();
    remark_on_materials();
    return builder_.take([this](int material) { return part_of(material); });
  }

 private:
  void read_statement(std::string_view keyword, std::string_view rest);
  void read_vertex(std::string_view rest);
  void read_texture(std::string_view rest);
  void read_face(std::string_view rest);
  [[nodiscard]] std::int64_t take_index(std::string_view& word, std::size_t count) const;
  void read_libraries(std::string_view rest);
  int material_number(std::string_view name);
  void check_end(std::string_view text) const;
  void build();
  void build_face(const Face& face);
  void sum_normals();
  void decode_colors();
  [[nodiscard]] Vector3<double> position(const Face& face, std::size_t corner) const;
  [[nodiscard]] Vector3<double> face_normal(const Face& face) const;
  [[nodiscard]] Vector3<double> normal_of(const Face& face, const Corner& corner) const;
  [[nodiscard]] const ObjMaterial* material_of(int number) const;
  [[nodiscard]] MeshPart part_of(int material);
  void remark_on_statements();
  void remark_on_materials();
  [[nodiscard]] Error error(const std::string& problem, const std::string& remedy) const {
    return {fmt::format("{}:{}", builder_.location(), line_), problem, remedy};
  }

  MeshBuilder builder_;
  std::filesystem::path folder_;
  std::vector<Vertex> vertices_;
  std::vector<std::array<float, 2>> textures_;
  std::vector<Vector3<double>> normals_;
  std::vector<Corner> corners_;
  std::vector<Face> faces_;
  double cutting_work_ = 0.0;
  std::set<std::string> libraries_;
  ObjMaterials materials_;
  std::map<std::string, int, std::less<>> numbers_;  //!< index of each material that faces use, from 0
  std::vector<std::string> names_;                   //!< names of these materials by index
  int material_ = no_material;
  long smoothing_group_ = 0;
  bool has_colors_ = false;
  float brightest_color_ = 0.0F;
  bool colors_are_whole_ = true;
  bool has_lines_ = false;
  bool has_free_forms_ = false;
  bool smooth_by_groups_ = false;
  long line_ = 0;
  //! Sums of the face normals of each smoothing group at each vertex.
  std::unordered_map<std::uint64_t, Vector3<double>> sums_;
};

void ObjReader::read_statement(std::string_view keyword, std::string_view rest) {
  double a = 0.0;
  double b = 0.0;
  double c = 0.0;
  if (keyword == "v") {
    read_vertex(rest);
  } else if (keyword == "vt") {
    read_texture(rest);
  } else if (keyword == "vn") {
    const bool whole = take_number(rest, a) && take_number(rest, b) && take_number(rest, c);
    normals_.push_back(whole ? Vector3<double>{a, b, c} : Vector3<double>{0.0, 0.0, 0.0});
  } else if (keyword == "f" || keyword == "fo") {
    read_face(rest);
  } else if (keyword == "s") {
    smooth_by_groups_ = true;
    smoothing_group_ = rest == "on" ? 1 : take_number(rest, a) ? std::lround(std::clamp(a, 0.0, 1e9)) : 0;
  } else if (keyword == "usemtl") {
    material_ = rest.empty() ? no_material : material_number(unquoted(rest));
  } else if (keyword == "mtllib") {
    read_libraries(rest);
  } else if (keyword == "l" || keyword == "p") {
    has_lines_ = true;
  } else if (keyword == "curv" || keyword == "curv2" || keyword == "surf") {
    has_free_forms_ = true;
  }
}

//! Reads one or two texture coordinates. Non-finite ones, such as 1.#QNAN from Windows programs,
//! become 0.
void ObjReader::read_texture(std::string_view rest) {
  std::array<float, 2> at{};
  for (float& coordinate : at) {
    double number = 0.0;
    const bool is_number = take_number(rest, number);
    const std::string_view word = is_number ? std::string_view() : take_word_of(rest);
    if (!word.empty() && word.find('#') == std::string_view::npos) {
      throw error("has texture coordinates that are not numbers", face_remedy);
    }
    coordinate = is_number && std::isfinite(number) ? static_cast<float>(number) : 0.0F;
  }
  textures_.push_back(at);
}

void ObjReader::read_vertex(std::string_view rest) {
  std::array<double, 7> numbers{};
  std::size_t count = 0;
  while (count < numbers.size() && take_number(rest, numbers.at(count))) {
    ++count;
  }
  if (count < 3) {
    throw error("has a vertex with fewer than three valid coordinates", face_remedy);
  }
  Vertex vertex = {{numbers[0], numbers[1], numbers[2]}, {1.0F, 1.0F, 1.0F}, count >= 6};
  if (vertex.has_color) {
    has_colors_ = true;
    const std::size_t first = count == 7 ? 4 : 3;  // after a weight, which only curves use
    for (std::size_t i = 0; i < 3; ++i) {
      vertex.color.at(i) = static_cast<float>(std::clamp(numbers.at(first + i), 0.0, 255.0));
      brightest_color_ = std::max(brightest_color_, vertex.color.at(i));
      colors_are_whole_ = colors_are_whole_ && vertex.color.at(i) == std::floor(vertex.color.at(i));
    }
  }
  vertices_.push_back(vertex);
  if (vertices_.size() > max_mesh_vertices) {
    throw error(fmt::format("has more than {} vertices", max_mesh_vertices), "simplify the mesh");
  }
}

std::int64_t ObjReader::take_index(std::string_view& word, std::size_t count) const {
  const std::size_t end = std::min(word.find('/'), word.size());
  std::string_view digits = word.substr(0, end);
  word.remove_prefix(std::min(end + 1, word.size()));
  if (digits.empty()) {
    return -1;
  }
  double number = 0.0;
  if (!take_number(digits, number) || number != std::floor(number) || number == 0.0 || std::abs(number) > 1e9) {
    throw error("has a face whose vertex index is not a whole number", face_remedy);
  }
  // Negative indices count back from the last vertex read so far.
  const auto index = static_cast<std::int64_t>(number);
  constexpr std::int64_t before_the_first = -2;
  return index > 0 ? index - 1
                   : (-index > static_cast<std::int64_t>(count) ? before_the_first
                                                                : static_cast<std::int64_t>(count) + index);
}

void ObjReader::read_face(std::string_view rest) {
  const std::size_t first = corners_.size();
  for (std::string_view word = take_word_of(rest); !word.empty() && word.front() != '#'; word = take_word_of(rest)) {
    if (corners_.size() - first >= max_face_corners) {
      throw error(fmt::format("has a face of more than {} corners", max_face_corners),
                  "export the mesh with triangulated faces");
    }
    Corner corner{};
    corner.vertex = take_index(word, vertices_.size());
    corner.texture = take_index(word, textures_.size());
    corner.normal = take_index(word, normals_.size());
    corners_.push_back(corner);
  }
  const std::size_t count = corners_.size() - first;
  if (count < 3) {
    has_lines_ = true;
    corners_.resize(first);
    return;
  }
  const auto sides = static_cast<double>(count);
  cutting_work_ += count > 4 ? sides * sides : 0.0;
  if (cutting_work_ > max_cutting_work) {
    throw error("has too many faces with many corners", "export the mesh with triangulated faces");
  }
  builder_.reserve(count - 2, 3 * (count - 2));
  faces_.push_back({first, static_cast<std::uint32_t>(count), material_, smoothing_group_, line_});
}

void ObjReader::read_libraries(std::string_view rest) {
  if (folder_.empty()) {
    return;
  }
  for (const std::string& name : library_names(rest, folder_)) {
    if (!libraries_.insert(name).second) {
      continue;
    }
    const std::filesystem::path file = file_of_mesh(folder_, name);
    if (file.empty()) {
      throw missing_file(builder_.location(), name);
    }
    add_obj_materials(
        read_whole_file(file, largest_library_bytes, "a material file is a short text file; check the path"),
        materials_);
  }
}

int ObjReader::material_number(std::string_view name) {
  constexpr std::size_t max_materials = 10'000;
  const auto [at, is_new] = numbers_.try_emplace(std::string(name), static_cast<int>(names_.size()));
  if (names_.size() >= max_materials) {
    throw error(fmt::format("uses more than {} materials", max_materials), "merge some of them");
  }
  if (is_new) {
    names_.emplace_back(name);
  }
  return at->second;
}

//! Throws Error if the file is truncated within a face. A file truncated between faces is a smaller
//! valid mesh.
void ObjReader::check_end(std::string_view text) const {
  const std::size_t line = text.find_last_of("\r\n");
  std::string_view last = line == std::string_view::npos ? text : text.substr(line + 1);
  if (take_word_of(last) != "f") {
    return;
  }
  int corners = 0;
  while (!take_word_of(last).empty()) {
    ++corners;
  }
  if (corners < 3) {
    throw error("ends in the middle of a face", "copy or export it again");
  }
}

Vector3<double> ObjReader::position(const Face& face, std::size_t corner) const {
  return vertices_[static_cast<std::size_t>(corners_[face.first_corner + corner].vertex)].position;
}

//! Returns a vector of twice the face's area, along its normal.
Vector3<double> ObjReader::face_normal(const Face& face) const {
  Vector3<double> sum = {0.0, 0.0, 0.0};
  for (std::size_t i = 1; i + 1 < face.corners; ++i) {
    sum = sum + cross(position(face, i) - position(face, 0), position(face, i + 1) - position(face, 0));
  }
  return sum;
}

std::uint64_t group_key(const Face& face, const Corner& corner) {
  return (static_cast<std::uint64_t>(face.smoothing_group) << 32U) ^ static_cast<std::uint64_t>(corner.vertex);
}

void ObjReader::sum_normals() {
  for (const Face& face : faces_) {
    for (std::size_t i = 0; i < face.corners && face.smoothing_group > 0; ++i) {
      const Corner& corner = corners_[face.first_corner + i];
      if (corner.normal < 0) {
        Vector3<double>& sum = sums_.try_emplace(group_key(face, corner), Vector3<double>{0.0, 0.0, 0.0}).first->second;
        sum = sum + face_normal(face);
      }
    }
  }
}

//! Returns the normal of a corner. Returns zero if neither the file nor the faces define one;
//! repair_normals() later replaces zeros.
Vector3<double> ObjReader::normal_of(const Face& face, const Corner& corner) const {
  if (corner.normal >= 0) {
    return normals_[static_cast<std::size_t>(corner.normal)];
  }
  const Vector3<double> sum = face.smoothing_group > 0 ? sums_.at(group_key(face, corner)) : face_normal(face);
  const double length = std::sqrt(dot(sum, sum));
  return length > 0.0 ? (1.0 / length) * sum : Vector3<double>{0.0, 0.0, 0.0};
}

//! Decodes vertex colors from sRGB. If all are whole numbers and some exceed 1, they range from 0
//! to 255.
void ObjReader::decode_colors() {
  const float white = colors_are_whole_ && brightest_color_ > 1.0F ? 255.0F : 1.0F;
  for (Vertex& vertex : vertices_) {
    for (float& color : vertex.color) {
      color = vertex.has_color ? srgb_decoded(std::min(color / white, 1.0F)) : 1.0F;
    }
  }
}

void ObjReader::build() {
  const auto is_there = [](std::int64_t index, std::size_t count) {
    return index < static_cast<std::int64_t>(count) && index >= -1;
  };
  for (const Face& face : faces_) {
    line_ = face.line;
    for (std::size_t i = face.first_corner; i < face.first_corner + face.corners; ++i) {
      const Corner& corner = corners_[i];
      if (corner.vertex < 0 || !is_there(corner.vertex, vertices_.size()) ||
          !is_there(corner.texture, textures_.size()) || !is_there(corner.normal, normals_.size())) {
        throw error("has a face that refers to a nonexistent vertex", face_remedy);
      }
      const Vector3<double>& p = vertices_[static_cast<std::size_t>(corner.vertex)].position;
      if (!(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z))) {
        throw error("has a vertex with a non-finite coordinate", "correct it, or export the mesh again");
      }
    }
  }
  sum_normals();
  decode_colors();
  for (const Face& face : faces_) {
    build_face(face);
  }
}

void ObjReader::build_face(const Face& face) {
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
    const Corner& corner = corners_[face.first_corner + i];
    const Vertex& from = vertices_[static_cast<std::size_t>(corner.vertex)];
    const Vector3<double> normal = normal_of(face, corner);
    const std::array<float, 2> texture =
        corner.texture >= 0 ? textures_[static_cast<std::size_t>(corner.texture)] : std::array<float, 2>{0.0F, 0.0F};
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
  const bool plain = corners_[face.first_corner].texture < 0;
  if (plain && !placed.name.empty()) {
    builder_.remark(fmt::format("has triangles without texture coordinates; they show a single texel of {}",
                                std::filesystem::path(placed.name).filename().string()));
  }
}

const ObjMaterial* ObjReader::material_of(int number) const {
  const auto found =
      number == no_material ? materials_.end() : materials_.find(names_[static_cast<std::size_t>(number)]);
  return found == materials_.end() ? nullptr : &found->second;
}

//! Returns the MeshPart for a material. If a material has black diffuse color but emits light, the
//! part has the color of the emitted light, because surfaces of a show emit light.
MeshPart ObjReader::part_of(int number) {
  MeshPart part;
  const ObjMaterial* const material = material_of(number);
  if (material == nullptr) {
    part.color = has_colors_ ? std::array<float, 3>{1.0F, 1.0F, 1.0F} : ObjMaterial().diffuse;
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

void ObjReader::remark_on_statements() {
  if (has_lines_) {
    builder_.remark("has points or lines, which are not drawn");
  }
  if (has_free_forms_) {
    builder_.remark("has free-form curves or surfaces (curv, surf), which are not drawn");
  }
}

void ObjReader::remark_on_materials() {
  constexpr std::size_t max_named = 5;
  std::vector<std::string> missing;
  for (const std::string& name : names_) {
    if (!folder_.empty() && !materials_.contains(name)) {
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
  return ObjReader(location, folder).read(text);
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
    add_obj_materials(
        read_whole_file(library, largest_library_bytes, "a material file is a short text file; check the path"),
        materials);
    for (const auto& [name, material] : materials) {
      add(material.diffuse_texture.name);
      add(material.emission_texture.name);
    }
  }
  return files;
}

}  // namespace ergodome
