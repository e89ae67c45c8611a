#include "content/mesh/formats/obj_statements.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <utility>

#include "content/files/whole_file.h"
#include "content/mesh/formats/obj_lines.h"
#include "content/mesh/formats/polygon_triangles.h"
#include "content/mesh/named_file.h"
#include "kernels/image/color_map.h"

namespace ergodome {

namespace {

constexpr const char* face_remedy = "export the mesh again";
//! Maximum work of triangulation: the sum of the squared number of corners over all faces with more
//! than four.
constexpr double max_cutting_work = 1e9;

//! Reads the statements of a file line by line.
class ObjStatementReader {
 public:
  ObjStatementReader(MeshBuilder& builder, const std::filesystem::path& folder) : builder_(builder), folder_(folder) {}

  ObjStatements read(std::string_view text) {
    for (ObjLines lines(text); lines.next();) {
      line_ = lines.line();
      throw_if_reading_stopped(builder_.location());
      read_statement(lines.keyword(), lines.rest());
    }
    check_end(text);
    if (!smooth_by_groups_) {
      std::ranges::for_each(file_.faces, [](ObjFace& face) { face.smoothing_group = 1; });
    }
    check_faces();
    decode_colors();
    return std::move(file_);
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
  void check_faces();
  void decode_colors();
  [[nodiscard]] Error error(const std::string& problem, const std::string& remedy) const {
    return {fmt::format("{}:{}", builder_.location(), line_), problem, remedy};
  }

  MeshBuilder& builder_;
  const std::filesystem::path& folder_;
  ObjStatements file_;
  double cutting_work_ = 0.0;
  std::set<std::string> libraries_;
  std::map<std::string, int, std::less<>> numbers_;  //!< index of each material that faces use, from 0
  int material_ = no_obj_material;
  long smoothing_group_ = 0;
  float brightest_color_ = 0.0F;
  bool colors_are_whole_ = true;
  bool smooth_by_groups_ = false;
  long line_ = 0;
};

void ObjStatementReader::read_statement(std::string_view keyword, std::string_view rest) {
  double a = 0.0;
  double b = 0.0;
  double c = 0.0;
  if (keyword == "v") {
    read_vertex(rest);
  } else if (keyword == "vt") {
    read_texture(rest);
  } else if (keyword == "vn") {
    const bool whole = take_number(rest, a) && take_number(rest, b) && take_number(rest, c);
    file_.normals.push_back(whole ? Vector3<double>{a, b, c} : Vector3<double>{0.0, 0.0, 0.0});
  } else if (keyword == "f" || keyword == "fo") {
    read_face(rest);
  } else if (keyword == "s") {
    smooth_by_groups_ = true;
    smoothing_group_ = rest == "on" ? 1 : take_number(rest, a) ? std::lround(std::clamp(a, 0.0, 1e9)) : 0;
  } else if (keyword == "usemtl") {
    material_ = rest.empty() ? no_obj_material : material_number(unquoted(rest));
  } else if (keyword == "mtllib") {
    read_libraries(rest);
  } else if (keyword == "l" || keyword == "p") {
    file_.has_lines = true;
  } else if (keyword == "curv" || keyword == "curv2" || keyword == "surf") {
    file_.has_free_forms = true;
  }
}

//! Reads up to two texture coordinates. Missing and non-finite ones, such as 1.#QNAN from Windows
//! programs, become 0. Throws Error for other words.
void ObjStatementReader::read_texture(std::string_view rest) {
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
  file_.textures.push_back(at);
}

void ObjStatementReader::read_vertex(std::string_view rest) {
  std::array<double, 7> numbers{};
  std::size_t count = 0;
  while (count < numbers.size() && take_number(rest, numbers.at(count))) {
    ++count;
  }
  if (count < 3) {
    throw error("has a vertex with fewer than three valid coordinates", face_remedy);
  }
  ObjVertex vertex = {{numbers[0], numbers[1], numbers[2]}, {1.0F, 1.0F, 1.0F}, count >= 6};
  if (vertex.has_color) {
    file_.has_colors = true;
    const std::size_t first = count == 7 ? 4 : 3;  // after a weight, which only curves use
    for (std::size_t i = 0; i < 3; ++i) {
      vertex.color.at(i) = static_cast<float>(std::clamp(numbers.at(first + i), 0.0, 255.0));
      brightest_color_ = std::max(brightest_color_, vertex.color.at(i));
      colors_are_whole_ = colors_are_whole_ && vertex.color.at(i) == std::floor(vertex.color.at(i));
    }
  }
  file_.vertices.push_back(vertex);
  if (file_.vertices.size() > max_mesh_vertices) {
    throw error(fmt::format("has more than {} vertices", max_mesh_vertices), "simplify the mesh");
  }
}

std::int64_t ObjStatementReader::take_index(std::string_view& word, std::size_t count) const {
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
  // Negative indices count back from the last vertex, texture coordinate or normal read so far.
  const auto index = static_cast<std::int64_t>(number);
  constexpr std::int64_t before_the_first = -2;
  return index > 0 ? index - 1
                   : (-index > static_cast<std::int64_t>(count) ? before_the_first
                                                                : static_cast<std::int64_t>(count) + index);
}

void ObjStatementReader::read_face(std::string_view rest) {
  const std::size_t first = file_.corners.size();
  for (std::string_view word = take_word_of(rest); !word.empty() && word.front() != '#'; word = take_word_of(rest)) {
    if (file_.corners.size() - first >= max_face_corners) {
      throw error(fmt::format("has a face of more than {} corners", max_face_corners),
                  "export the mesh with triangulated faces");
    }
    ObjCorner corner{};
    corner.vertex = take_index(word, file_.vertices.size());
    corner.texture = take_index(word, file_.textures.size());
    corner.normal = take_index(word, file_.normals.size());
    file_.corners.push_back(corner);
  }
  const std::size_t count = file_.corners.size() - first;
  if (count < 3) {
    file_.has_lines = true;
    file_.corners.resize(first);
    return;
  }
  const auto sides = static_cast<double>(count);
  cutting_work_ += count > 4 ? sides * sides : 0.0;
  if (cutting_work_ > max_cutting_work) {
    throw error("has too many faces with many corners", "export the mesh with triangulated faces");
  }
  builder_.reserve(count - 2, 3 * (count - 2));
  file_.faces.push_back({first, static_cast<std::uint32_t>(count), material_, smoothing_group_, line_});
}

void ObjStatementReader::read_libraries(std::string_view rest) {
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
    add_obj_materials(read_whole_file(file, largest_obj_library_bytes, obj_library_remedy), file_.materials);
  }
}

int ObjStatementReader::material_number(std::string_view name) {
  constexpr std::size_t max_materials = 10'000;
  const auto [at, is_new] = numbers_.try_emplace(std::string(name), static_cast<int>(file_.names.size()));
  if (file_.names.size() >= max_materials) {
    throw error(fmt::format("uses more than {} materials", max_materials), "merge some of them");
  }
  if (is_new) {
    file_.names.emplace_back(name);
  }
  return at->second;
}

//! Throws Error if the text ends, without a line break, in a face with fewer than three corners:
//! the file is truncated. A file truncated between faces is a smaller valid mesh.
void ObjStatementReader::check_end(std::string_view text) const {
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

//! Throws Error unless the indices of all faces exist and their vertices have finite positions.
void ObjStatementReader::check_faces() {
  const auto is_there = [](std::int64_t index, std::size_t count) {
    return index < static_cast<std::int64_t>(count) && index >= -1;
  };
  for (const ObjFace& face : file_.faces) {
    line_ = face.line;
    for (std::size_t i = face.first_corner; i < face.first_corner + face.corners; ++i) {
      const ObjCorner& corner = file_.corners[i];
      if (corner.vertex < 0 || !is_there(corner.vertex, file_.vertices.size()) ||
          !is_there(corner.texture, file_.textures.size()) || !is_there(corner.normal, file_.normals.size())) {
        throw error("has a face that refers to a nonexistent vertex", face_remedy);
      }
      const Vector3<double>& p = file_.vertices[static_cast<std::size_t>(corner.vertex)].position;
      if (!(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z))) {
        throw error("has a vertex with a non-finite coordinate", "correct it, or export the mesh again");
      }
    }
  }
}

//! Decodes vertex colors from sRGB. If all are whole numbers and some exceed 1, they range from 0
//! to 255.
void ObjStatementReader::decode_colors() {
  const float white = colors_are_whole_ && brightest_color_ > 1.0F ? 255.0F : 1.0F;
  for (ObjVertex& vertex : file_.vertices) {
    for (float& color : vertex.color) {
      color = vertex.has_color ? srgb_decoded(std::min(color / white, 1.0F)) : 1.0F;
    }
  }
}

}  // namespace

ObjStatements read_obj_statements(std::string_view text, const std::filesystem::path& folder, MeshBuilder& builder) {
  return ObjStatementReader(builder, folder).read(text);
}

}  // namespace ergodome
