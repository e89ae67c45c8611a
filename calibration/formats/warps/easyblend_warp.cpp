#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "calibration/formats/warps/foreign_warp.h"
#include "calibration/formats/warps/triangle_warp.h"
#include "calibration/formats/warps/warp_text.h"
#include "kernels/core/angles.h"

namespace ergodome {

namespace {

//! Keywords with a number, and their defaults.
const std::map<std::string, double, std::less<>> usual_numbers = {
    {"ORTHO_LEFT", 0.0},
    {"ORTHO_RIGHT", 1.0},
    {"ORTHO_TOP", 1.0},
    {"ORTHO_BOTTOM", 0.0},
    {"PERSPECTIVE_XOFFSET", 0.0},
    {"PERSPECTIVE_YOFFSET", 0.0},
    {"PERSPECTIVE_ZOFFSET", 0.0},
    {"PERSPECTIVE_ROLL", 0.0},
    {"PERSPECTIVE_PITCH", 0.0},
    {"PERSPECTIVE_YAW", 0.0},
    {"PERSPECTIVE_LEFT", 0.0},
    {"PERSPECTIVE_RIGHT", 0.0},
    {"PERSPECTIVE_TOP", 0.0},
    {"PERSPECTIVE_BOTTOM", 0.0},
    {"NATIVEXRES", 0.0},
    {"NATIVEYRES", 0.0},
    {"GAMMA", 2.2},
    {"SUBVERSION", 5.0},
    {"DO_NO_WARP", 0.0},
    {"USE_SPHERE_SAMPLE_COORDINATE_SYSTEM", 0.0},
    {"FRUSTUM_EULER_ANGLES", 0.0},
    {"FRUSTUM_EULER_YAW", 0.0},
    {"FRUSTUM_EULER_PITCH", 0.0},
    {"FRUSTUM_EULER_ROLL", 0.0},
    {"APPLY_MASK", 0.0},
    {"APPLY_BLACK_LEVEL", 0.0},
    {"APPLY_COLOR", 0.0},
};

bool is_keyword(std::string_view word) {
  return !word.empty() && ((word[0] >= 'A' && word[0] <= 'Z') || (word[0] >= 'a' && word[0] <= 'z'));
}

class EasyblendParser {
 public:
  EasyblendParser(std::string_view text, const std::string& file) : text_(text, file), file_(file) {}

  ForeignWarp parse() {
    while (const auto line = text_.next()) {
      read_line(*line);
    }
    if (!is_openmesh_) {
      throw Error(file_, "is not an EasyBlend mesh", "name a file with the line \"OPENMESH Version 1.1\"");
    }
    refuse_unsupported();
    require_counts();
    ForeignWarp warp;
    warp.view = view_of_keys();
    put_nodes_on_raster();
    warp.mesh = warp_from_triangles(std::move(nodes_), triangles_, file_);
    for (const char* key : {"APPLY_MASK", "APPLY_BLACK_LEVEL", "APPLY_COLOR"}) {
      if (number(key) != 0.0) {
        notes_.push_back(
            fmt::format("{} needs an image that the file does not contain; name that image in the dome setup", key));
      }
    }
    warp.notes = std::move(notes_);
    return warp;
  }

 private:
  [[nodiscard]] double number(const char* key) const { return numbers_.find(key)->second; }

  void read_line(std::string_view line) {
    std::string_view rest = line;
    const std::string_view word = take_word(rest);
    if (word == "[") {
      read_face(rest);
    } else if (is_keyword(word) && word != "nan" && word != "inf") {
      read_keyword(word, rest);
    } else {
      read_node(line);
    }
  }

  void read_keyword(std::string_view word, std::string_view rest) {
    if (word == "OPENMESH") {
      is_openmesh_ = true;
    } else if (word == "VERTICES") {
      vertices_ = text_.whole(take_word(rest), "the number of vertices", 0, max_mesh_nodes);
    } else if (word == "FACES") {
      faces_ = text_.whole(take_word(rest), "the number of faces", 0, max_mesh_nodes);
    } else if (word == "MAPPING") {
      require_word(word, take_word(rest), "NORMALIZED");
    } else if (word == "SAMPLING") {
      require_word(word, take_word(rest), "LINEAR");
    } else if (word == "PROJECTION") {
      require_word(word, take_word(rest), "PERSPECTIVE");
    } else if (const auto at = numbers_.find(word); at != numbers_.end()) {
      at->second = text_.number(take_word(rest), word);
      has_view_ = has_view_ || word == "PERSPECTIVE_LEFT" || word == "PERSPECTIVE_RIGHT" || word == "PERSPECTIVE_TOP" ||
                  word == "PERSPECTIVE_BOTTOM";
    } else if (word != "LABEL") {
      constexpr std::size_t max_notes = 20;
      if (notes_.size() < max_notes) {
        notes_.push_back(fmt::format("the unknown keyword {} is ignored", shown_of(word)));
      }
    }
  }

  void require_word(std::string_view key, std::string_view found, std::string_view supported) const {
    if (found != supported) {
      throw text_.error(fmt::format("has {} {}", key, shown_of(found)),
                        fmt::format("only {} is supported; export the mesh with it", supported));
    }
  }

  void read_node(std::string_view rest) {
    WarpNode node;
    node.x = static_cast<float>(text_.number(take_word(rest), "x"));
    node.y = static_cast<float>(text_.number(take_word(rest), "y"));
    const double intensity = text_.number(take_word(rest), "the intensity");
    const double s = text_.number(take_word(rest), "s");
    const double t = text_.number(take_word(rest), "t");
    if (!(intensity >= 0.0 && intensity <= 255.0)) {
      throw text_.error(fmt::format("has an intensity of {:g}", intensity), "write a number from 0 to 255");
    }
    if (!take_word(rest).empty()) {
      throw text_.error("has more than five numbers", "write x y intensity s t on the line");
    }
    if (nodes_.size() >= max_mesh_nodes) {
      throw text_.error(fmt::format("has more than {} nodes", max_mesh_nodes), "export a coarser mesh");
    }
    // In the file, t increases to the left and s downward.
    node.u = static_cast<float>(1.0 - t);
    node.v = static_cast<float>(s);
    node.intensity = static_cast<float>(intensity / 255.0);
    nodes_.push_back(node);
  }

  void read_face(std::string_view rest) {
    WarpTriangle triangle{};
    for (std::uint32_t& node : triangle) {
      node = static_cast<std::uint32_t>(text_.whole(take_word(rest), "a face's node", 0, max_mesh_nodes - 1));
    }
    if (take_word(rest) != "]") {
      throw text_.error("has a face without exactly three nodes", "write [ a b c ]");
    }
    if (triangles_.size() >= max_mesh_nodes) {
      throw text_.error(fmt::format("has more than {} faces", max_mesh_nodes), "export a coarser mesh");
    }
    triangles_.push_back(triangle);
  }

  void refuse_unsupported() const {
    for (const char* key : {"DO_NO_WARP", "USE_SPHERE_SAMPLE_COORDINATE_SYSTEM", "FRUSTUM_EULER_ANGLES",
                            "PERSPECTIVE_XOFFSET", "PERSPECTIVE_YOFFSET", "PERSPECTIVE_ZOFFSET"}) {
      if (number(key) != 0.0) {
        throw Error(file_, fmt::format("uses {} {:g}, which is not supported", key, number(key)),
                    "export the mesh without it, for an eye at the dome's center");
      }
    }
    if (!(number("GAMMA") >= 0.1 && number("GAMMA") <= 10.0)) {
      throw Error(file_, fmt::format("has GAMMA {:g}", number("GAMMA")), "write a gamma from 0.1 to 10");
    }
    if (!(number("NATIVEXRES") >= 1.0 && number("NATIVEYRES") >= 1.0)) {
      throw Error(file_, "does not give the size of its raster", "write NATIVEXRES and NATIVEYRES");
    }
    if (number("ORTHO_LEFT") == number("ORTHO_RIGHT") || number("ORTHO_TOP") == number("ORTHO_BOTTOM")) {
      throw Error(file_, "has a raster of width or height 0",
                  "give ORTHO_LEFT and ORTHO_RIGHT, and ORTHO_TOP and ORTHO_BOTTOM, different values");
    }
  }

  void require_counts() const {
    const auto found_nodes = static_cast<long long>(nodes_.size());
    const auto found_faces = static_cast<long long>(triangles_.size());
    if (found_nodes != vertices_ || found_faces != faces_) {
      throw Error(file_,
                  fmt::format("declares {} vertices and {} faces, but has {} and {}", vertices_, faces_, found_nodes,
                              found_faces),
                  "the file is truncated or damaged; export it again");
    }
  }

  [[nodiscard]] std::optional<WarpView> view_of_keys() const {
    if (!has_view_) {
      return std::nullopt;
    }
    WarpView view;
    view.frustum = {number("PERSPECTIVE_LEFT"), number("PERSPECTIVE_RIGHT"), number("PERSPECTIVE_TOP"),
                    number("PERSPECTIVE_BOTTOM")};
    check_view(view.frustum, file_);
    view.orientation = orientation_of({turned({1, 0, 0}), turned({0, 1, 0}), turned({0, 0, -1})});
    return view;
  }

  //! Rotates a vector around the x axis by the pitch (up), then around y by the yaw (to the left),
  //! then around z by the roll (counterclockwise).
  [[nodiscard]] Vector3<double> turned(Vector3<double> v) const {
    const auto turn = [this](const char* key, double& a, double& b) {
      const double angle = one_degree * number(key);
      const double first = std::cos(angle) * a - std::sin(angle) * b;
      b = std::sin(angle) * a + std::cos(angle) * b;
      a = first;
    };
    turn("PERSPECTIVE_PITCH", v.y, v.z);
    turn("PERSPECTIVE_YAW", v.z, v.x);
    turn("PERSPECTIVE_ROLL", v.x, v.y);
    return v;
  }

  void put_nodes_on_raster() {
    const double left = number("ORTHO_LEFT");
    const double bottom = number("ORTHO_BOTTOM");
    for (WarpNode& node : nodes_) {
      const double x = (node.x / number("NATIVEXRES") - left) / (number("ORTHO_RIGHT") - left);
      const double y = (node.y / number("NATIVEYRES") - bottom) / (number("ORTHO_TOP") - bottom);
      constexpr double farthest = 1e4;
      if (!(std::abs(x) <= farthest && std::abs(y) <= farthest)) {
        throw Error(file_, "has a vertex far outside its raster", "check NATIVEXRES, NATIVEYRES and the ORTHO_ values");
      }
      node.x = static_cast<float>(x);
      node.y = static_cast<float>(1.0 - y);
      // Intensities multiply the transmitted values; light is proportional to these to the power of
      // gamma.
      node.intensity = std::pow(node.intensity, static_cast<float>(number("GAMMA")));
    }
  }

  WarpText text_;
  std::string file_;
  bool is_openmesh_ = false;
  bool has_view_ = false;
  long long vertices_ = 0;
  long long faces_ = 0;
  std::map<std::string, double, std::less<>> numbers_ = usual_numbers;
  std::vector<WarpNode> nodes_;
  std::vector<WarpTriangle> triangles_;
  std::vector<std::string> notes_;
};

}  // namespace

ForeignWarp parse_easyblend_warp(std::string_view text, const std::string& file) {
  return EasyblendParser(text, file).parse();
}

}  // namespace ergodome
