#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <utility>

#include "calibration/formats/warps/foreign_warp.h"
#include "calibration/formats/warps/triangle_warp.h"
#include "calibration/formats/warps/warp_text.h"

namespace ergodome {

namespace {

class ObjWarpParser {
 public:
  ObjWarpParser(std::string_view text, const std::string& file) : text_(text, file), file_(file) {}

  ForeignWarp parse() {
    while (const auto line = text_.next()) {
      read_line(*line);
    }
    if (positions_.empty() && textures_.empty()) {
      throw Error(file_, "is not a Wavefront OBJ mesh", "name a file with lines v, vt and f");
    }
    if (positions_.empty() || triangles_.empty()) {
      throw Error(file_, positions_.empty() ? "has no vertices" : "has no faces",
                  "a warp needs lines v, vt and f; export it with texture coordinates");
    }
    nodes_.resize(positions_.size());
    for (WarpTriangle& triangle : triangles_) {
      for (std::uint32_t& node : triangle) {
        node = (node & further_bit) != 0 ? static_cast<std::uint32_t>(positions_.size() + (node & ~further_bit)) : node;
      }
    }
    nodes_.insert(nodes_.end(), further_nodes_.begin(), further_nodes_.end());
    std::vector<std::string> notes;
    if (coloured_) {
      notes.emplace_back("vertex colors are ignored; use a blend_mask for the projector");
    }
    return {warp_from_triangles(std::move(nodes_), triangles_, file_), std::nullopt, std::move(notes)};
  }

 private:
  struct Pair {
    double first;
    double second;
  };

  void read_line(std::string_view line) {
    std::string_view rest = line;
    const std::string_view word = take_word(rest);
    if (word == "v") {
      read_position(rest);
    } else if (word == "vt") {
      const double u = text_.number(take_word(rest), "u");
      textures_.push_back({u, text_.number(take_word(rest), "v")});
      require_room(textures_.size());
    } else if (word == "f") {
      read_face(rest);
    }
    // Skips normals, groups and materials, which a warp does not use.
  }

  void require_room(std::size_t count) const {
    if (count > max_mesh_nodes) {
      throw text_.error(fmt::format("has more than {} vertices, texture coordinates or triangles", max_mesh_nodes),
                        "export a coarser mesh");
    }
  }

  void read_position(std::string_view rest) {
    const double x = text_.number(take_word(rest), "x");
    const double y = text_.number(take_word(rest), "y");
    const double z = text_.number(take_word(rest), "z");
    coloured_ = coloured_ || !take_word(rest).empty();
    if (!positions_.empty() && z != depth_) {
      throw text_.error(fmt::format("has z = {:g}, but other vertices have z = {:g}", z, depth_),
                        "export a flat mesh with x and y from -1 to 1 across the raster, not the shape of the screen");
    }
    depth_ = z;
    positions_.push_back({x, y});
    require_room(positions_.size());
  }

  //! Removes one index from the front of a face's corner ("v/vt/vn") and returns it; returns 0 if
  //! there is none.
  long long taken_index(std::string_view& corner, std::size_t count) const {
    long long index = 0;
    const auto [end, problem] = std::from_chars(corner.data(), corner.data() + corner.size(), index);
    if (problem != std::errc()) {
      return 0;
    }
    corner.remove_prefix(static_cast<std::size_t>(end - corner.data()));
    // Negative indices count back from the last element read so far.
    index = index < 0 ? static_cast<long long>(count) + index + 1 : index;
    if (index < 1 || index > static_cast<long long>(count)) {
      throw text_.error(fmt::format("refers to number {}, but the lines before it define {}", index, count),
                        "use only vertices and texture coordinates of earlier lines, counted from 1");
    }
    return index;
  }

  std::uint32_t corner_of(std::string_view corner) {
    const std::string_view whole = corner;
    const long long position = taken_index(corner, positions_.size());
    long long texture = position;
    if (corner.starts_with('/')) {
      corner.remove_prefix(1);
      texture = taken_index(corner, textures_.size());
      if (corner.starts_with('/')) {
        corner = {};
      }
    }
    if (position == 0 || texture == 0 || !corner.empty() || texture > static_cast<long long>(textures_.size())) {
      throw text_.error(fmt::format("has the corner \"{}\"", shown_of(whole)),
                        "write vertex/texture, such as 1/1; every corner of a warp needs texture coordinates");
    }
    return node_of(static_cast<std::size_t>(position - 1), static_cast<std::size_t>(texture - 1));
  }

  //! Returns the node with a position and a texture coordinate. For the first texture coordinate of
  //! a position, the node's index is that of the position, so that complete grids can be
  //! recognized.
  std::uint32_t node_of(std::size_t position, std::size_t texture) {
    nodes_.resize(std::max(nodes_.size(), positions_.size()));
    first_texture_.resize(positions_.size(), none);
    const auto [u, v] = textures_[texture];
    const auto [x, y] = positions_[position];
    const WarpNode node = {static_cast<float>(0.5 * (x + 1.0)), static_cast<float>(0.5 * (1.0 - y)),
                           static_cast<float>(u), static_cast<float>(1.0 - v)};
    std::size_t& first = first_texture_[position];
    if (first == none || first == texture) {
      first = texture;
      nodes_[position] = node;
      return static_cast<std::uint32_t>(position);
    }
    const auto [at, added] = further_.emplace(std::pair(position, texture), 0U);
    if (added) {
      further_nodes_.push_back(node);
      at->second = static_cast<std::uint32_t>(further_nodes_.size() - 1) | further_bit;
    }
    return at->second;
  }

  void read_face(std::string_view rest) {
    std::vector<std::uint32_t> corners;
    for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest)) {
      corners.push_back(corner_of(word));
    }
    if (corners.size() < 3) {
      throw text_.error("is a face with fewer than three corners", "write, for example, f 1/1 2/2 3/3");
    }
    for (std::size_t i = 2; i < corners.size(); ++i) {
      triangles_.push_back({corners[0], corners[i - 1], corners[i]});
    }
    require_room(triangles_.size());
  }

  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  static constexpr std::uint32_t further_bit = 1U << 31U;

  WarpText text_;
  std::string file_;
  std::vector<Pair> positions_;
  std::vector<Pair> textures_;
  std::vector<WarpNode> nodes_;
  std::vector<std::size_t> first_texture_;
  std::map<std::pair<std::size_t, std::size_t>, std::uint32_t> further_;
  std::vector<WarpNode> further_nodes_;
  std::vector<WarpTriangle> triangles_;
  double depth_ = 0.0;
  bool coloured_ = false;
};

}  // namespace

ForeignWarp parse_obj_warp(std::string_view text, const std::string& file) { return ObjWarpParser(text, file).parse(); }

}  // namespace ergodome
