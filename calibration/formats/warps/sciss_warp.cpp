#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

#include "calibration/formats/warps/foreign_warp.h"
#include "calibration/formats/warps/triangle_warp.h"
#include "calibration/formats/warps/warp_text.h"

namespace ergodome {

namespace {

static_assert(std::endian::native == std::endian::little, "numbers are stored as a little-endian machine has them");

//! Values of the field for the kind of indices in files of version 2.
constexpr std::uint32_t list_of_triangles = 4;
constexpr std::uint32_t strip_of_triangles = 5;

struct Quaternion {
  double x;
  double y;
  double z;
  double w;
};

Vector3<double> rotated(const Quaternion& q, const Vector3<double>& v) {
  const Vector3<double> axis = {q.x, q.y, q.z};
  const Vector3<double> across = 2.0 * cross(axis, v);
  return v + q.w * across + cross(axis, across);
}

class ScissParser {
 public:
  ScissParser(std::string_view bytes, const std::string& file) : rest_(bytes), file_(file) {}

  ForeignWarp parse() {
    read_head();
    ForeignWarp warp;
    warp.view = read_view(warp.notes);
    const auto kind = taken<std::uint32_t>("the mesh's size");
    const auto size = taken<std::uint32_t>("the mesh's size");
    std::vector<WarpNode> nodes = read_nodes(version_ == 1 ? std::uint64_t{kind} * size : size);
    const std::vector<std::uint32_t> indices = read_indices();
    if (!rest_.empty()) {
      throw Error(file_, fmt::format("has {} extra bytes after its last index", rest_.size()),
                  "the file is damaged; export it again");
    }
    if (version_ == 1 && indices.empty()) {
      check_mesh_size(kind, size, file_);
      warp.mesh = in_reading_order(
          {MeshTopology::rectangular, static_cast<int>(kind), static_cast<int>(size), std::move(nodes)});
      return warp;
    }
    warp.mesh = warp_from_triangles(std::move(nodes), triangles_of(indices, kind), file_);
    return warp;
  }

 private:
  template <class T>
  T taken(const char* what) {
    if (rest_.size() < sizeof(T)) {
      throw Error(file_, fmt::format("ends before {}", what), "the file is truncated or damaged; export it again");
    }
    T value;
    rest_.copy(reinterpret_cast<char*>(&value), sizeof(T));
    rest_.remove_prefix(sizeof(T));
    return value;
  }

  double taken_number(const char* what) {
    constexpr double largest = 1e4;
    const double value = taken<float>(what);
    if (!(std::abs(value) <= largest)) {
      throw Error(file_, fmt::format("has the value {} in {}", value, what),
                  "export it with finite values from -10,000 to 10,000");
    }
    return value;
  }

  void read_head() {
    if (!rest_.starts_with("SGC")) {
      throw Error(file_, "is not a SCISS warp", "name a file that begins with \"SGC\"");
    }
    rest_.remove_prefix(3);
    // Some programs write the version as a digit, others as a number.
    const int version = taken<std::uint8_t>("its version");
    version_ = version >= '0' ? version - '0' : version;
    if (version_ != 1 && version_ != 2) {
      throw Error(file_, fmt::format("has the unsupported version {}", version), "export it as version 1 or 2");
    }
    if (const auto type = taken<std::uint32_t>("its type of mapping"); type != 0) {
      throw Error(file_,
                  type == 1 ? std::string("uses a cube map") : fmt::format("has the unsupported mapping type {}", type),
                  "export it with a planar mapping (type 0)");
    }
  }

  WarpView read_view(std::vector<std::string>& notes) {
    Quaternion q = {taken_number("the quaternion"), taken_number("the quaternion"), taken_number("the quaternion"),
                    taken_number("the quaternion")};
    const double length = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
    constexpr double rounding = 0.01;
    if (!(std::abs(length - 1.0) <= rounding)) {
      throw Error(file_, fmt::format("has a direction quaternion of length {:g}", length),
                  "export it with a quaternion of length 1");
    }
    q = {q.x / length, q.y / length, q.z / length, q.w / length};
    const Vector3<double> position = {taken_number("the position"), taken_number("the position"),
                                      taken_number("the position")};
    if (position.x != 0.0 || position.y != 0.0 || position.z != 0.0) {
      notes.push_back(
          fmt::format("its position ({:g}, {:g}, {:g}) is ignored: the view is assumed to be from the dome's "
                      "center",
                      position.x, position.y, position.z));
    }
    WarpView view;
    view.frustum.up_deg = taken_number("the field of view");
    view.frustum.down_deg = taken_number("the field of view");
    view.frustum.left_deg = taken_number("the field of view");
    view.frustum.right_deg = taken_number("the field of view");
    check_view(view.frustum, file_);
    view.orientation = orientation_of({rotated(q, {1, 0, 0}), rotated(q, {0, 1, 0}), rotated(q, {0, 0, -1})});
    return view;
  }

  std::vector<WarpNode> read_nodes(std::uint64_t count) {
    constexpr std::size_t node_bytes = 6 * sizeof(float);
    if (count > max_mesh_nodes || count > rest_.size() / node_bytes) {
      throw Error(file_, fmt::format("declares {} nodes, but is too short for them", count),
                  "the file is truncated or damaged; export it again");
    }
    std::vector<WarpNode> nodes;
    nodes.reserve(count);
    for (std::uint64_t i = 0; i < count; ++i) {
      WarpNode node;
      node.x = static_cast<float>(taken_number("a node"));
      node.y = static_cast<float>(taken_number("a node"));
      taken<float>("a node");  // skips z, which a flat raster does not need
      node.u = static_cast<float>(taken_number("a node"));
      node.v = static_cast<float>(1.0 - taken_number("a node"));
      taken<float>("a node");
      nodes.push_back(node);
    }
    return nodes;
  }

  std::vector<std::uint32_t> read_indices() {
    const auto count = taken<std::uint32_t>("its number of indices");
    if (count > rest_.size() / sizeof(std::uint32_t)) {
      throw Error(file_, fmt::format("declares {} indices, but is too short for them", count),
                  "the file is truncated or damaged; export it again");
    }
    std::vector<std::uint32_t> indices(count);
    if (count > 0) {
      std::memcpy(indices.data(), rest_.data(), count * sizeof(std::uint32_t));
      rest_.remove_prefix(count * sizeof(std::uint32_t));
    }
    return indices;
  }

  [[nodiscard]] std::vector<WarpTriangle> triangles_of(const std::vector<std::uint32_t>& indices,
                                                       std::uint32_t kind) const {
    if (version_ == 1 || kind == strip_of_triangles) {
      return triangles_of_strip(indices);
    }
    if (kind != list_of_triangles || indices.size() % 3 != 0) {
      throw Error(file_,
                  kind != list_of_triangles
                      ? fmt::format("has indices of the unknown type {}", kind)
                      : fmt::format("has {} indices, which do not form whole triangles", indices.size()),
                  "export triangles (type 4) or triangle strips (type 5)");
    }
    std::vector<WarpTriangle> triangles;
    for (std::size_t i = 0; i < indices.size(); i += 3) {
      triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
    }
    return triangles;
  }

  std::string_view rest_;
  std::string file_;
  int version_ = 0;
};

}  // namespace

ForeignWarp parse_sciss_warp(std::string_view bytes, const std::string& file) {
  return ScissParser(bytes, file).parse();
}

}  // namespace ergodome
