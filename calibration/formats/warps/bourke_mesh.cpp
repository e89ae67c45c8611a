#include "calibration/formats/warps/bourke_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "calibration/warps/text_lines.h"
#include "content/files/whole_file.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

//! Maximum size of a file: sufficient for every node of the largest mesh.
constexpr std::size_t max_mesh_bytes = std::size_t{2} << 30U;
//! Maximum coordinate: far outside any raster or image.
constexpr double largest_mesh_coordinate = 1e4;
//! Size of "0 0 0 0 0", the shortest line of a node.
constexpr std::size_t min_node_bytes = 9;

std::string shown_word(std::string_view word) { return std::string(word.substr(0, 40)); }

class BourkeParser {
 public:
  BourkeParser(std::string_view text, const std::string& file, double half_width)
      : lines_(text), bytes_(text.size()), file_(file), half_width_(half_width) {}

  WarpMesh parse() {
    read_type();
    read_size();
    const std::size_t count = static_cast<std::size_t>(mesh_.columns) * static_cast<std::size_t>(mesh_.rows);
    if (bytes_ / min_node_bytes < count) {
      throw error(fmt::format("declares {} nodes, but is too short for them", count),
                  "the file is truncated or damaged; export it again");
    }
    mesh_.nodes.reserve(count);
    while (mesh_.nodes.size() < count) {
      mesh_.nodes.push_back(read_node(count));
    }
    if (lines_.next()) {
      throw error(fmt::format("extra line after the last of {} nodes", count),
                  "correct the mesh size in the second line");
    }
    if (std::none_of(mesh_.nodes.begin(), mesh_.nodes.end(), [](const WarpNode& node) { return node.valid; })) {
      throw Error(file_, "has nothing to draw, because every intensity is negative", "export it again");
    }
    put_top_row_first();
    return std::move(mesh_);
  }

 private:
  [[nodiscard]] std::string location() const { return fmt::format("{}:{}", file_, std::max(lines_.number(), 1)); }
  [[nodiscard]] Error error(const std::string& problem, const std::string& remedy) const {
    return {location(), problem, remedy};
  }

  std::string_view line(std::string_view wanted) {
    const auto found = lines_.next();
    if (!found) {
      throw error(fmt::format("the file ends before {}", wanted), "the file is truncated or damaged; export it again");
    }
    return *found;
  }

  void read_type() {
    std::string_view rest = line("the mesh's type");
    const auto type = whole_number_of(take_word(rest));
    if (!type || (*type != 1 && *type != 2) || !take_word(rest).empty()) {
      throw error("is not a mesh type", "write only 2 (rectangular) or 1 (polar) on the first line");
    }
    mesh_.topology = *type == 2 ? MeshTopology::rectangular : MeshTopology::polar;
  }

  void read_size() {
    std::string_view rest = line("the mesh's size");
    const auto columns = whole_number_of(take_word(rest));
    const auto rows = whole_number_of(take_word(rest));
    if (!columns || !rows || !take_word(rest).empty()) {
      throw error("is not a mesh size", "write the number of columns and the number of rows");
    }
    check_mesh_size(*columns, *rows, location());
    mesh_.columns = static_cast<int>(*columns);
    mesh_.rows = static_cast<int>(*rows);
  }

  WarpNode read_node(std::size_t count) {
    std::string_view rest = line(fmt::format("node {} of {}", mesh_.nodes.size() + 1, count));
    double value[5];
    for (double& each : value) {
      const std::string_view word = take_word(rest);
      const auto number = number_of(word);
      if (word.empty() || !number) {
        throw error(word.empty() ? "has fewer than five numbers"
                                 : fmt::format("has \"{}\" where a number is needed", shown_word(word)),
                    "write x y u v intensity on the line");
      }
      if (!(std::abs(*number) <= largest_mesh_coordinate)) {
        throw error(fmt::format("has the value {}, which is not finite or too large", shown_word(word)),
                    "write finite numbers; to leave out a node, give it a negative intensity");
      }
      each = *number;
    }
    if (!take_word(rest).empty()) {
      throw error("has more than five numbers", "write x y u v intensity on the line");
    }
    return {static_cast<float>(0.5 * (value[0] / half_width_ + 1.0)),
            static_cast<float>(0.5 * (1.0 - value[1])),
            static_cast<float>(value[2]),
            static_cast<float>(1.0 - value[3]),
            static_cast<float>(std::max(value[4], 0.0)),
            value[4] >= 0.0};
  }

  [[nodiscard]] double sum_of_y(int row) const {
    double sum = 0.0;
    for (int column = 0; column < mesh_.columns; ++column) {
      sum += mesh_.at(column, row).y;
    }
    return sum;
  }

  void put_top_row_first() {
    if (mesh_.topology == MeshTopology::polar || sum_of_y(0) <= sum_of_y(mesh_.rows - 1)) {
      return;
    }
    for (int row = 0; row < mesh_.rows / 2; ++row) {
      std::swap_ranges(&mesh_.at(0, row), &mesh_.at(0, row) + mesh_.columns, &mesh_.at(0, mesh_.rows - 1 - row));
    }
  }

  TextLines lines_;
  std::size_t bytes_;
  std::string file_;
  double half_width_;
  WarpMesh mesh_;
};

}  // namespace

WarpMesh parse_bourke_mesh(std::string_view text, const std::string& file, double half_width) {
  if (!(half_width >= 0.01 && half_width <= 100.0)) {
    throw Error(
        file, fmt::format("cannot be read for a raster with aspect ratio {}, which is outside 0.01 to 100", half_width),
        "give the aspect ratio (width / height) of the projector's raster, or 1");
  }
  return BourkeParser(text, file, half_width).parse();
}

WarpMesh read_bourke_mesh(const std::filesystem::path& path, double half_width) {
  return parse_bourke_mesh(read_whole_file(path, max_mesh_bytes, "give a mesh file in Paul Bourke's format"),
                           path.string(), half_width);
}

std::string to_bourke_mesh(const WarpMesh& mesh, double half_width) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  const bool polar = mesh.topology == MeshTopology::polar;
  fmt::format_to(out, "{}\n{} {}\n", polar ? 1 : 2, mesh.columns, mesh.rows);
  for (int line = 0; line < mesh.rows; ++line) {
    for (int column = 0; column < mesh.columns; ++column) {
      const WarpNode& node = mesh.at(column, polar ? line : mesh.rows - 1 - line);
      fmt::format_to(out, "{:.9g} {:.9g} {:.9g} {:.9g} {:.9g}\n", half_width * (2.0 * node.x - 1.0), 1.0 - 2.0 * node.y,
                     node.u, 1.0 - node.v, node.valid ? static_cast<double>(node.intensity) : -1.0);
    }
  }
  return fmt::to_string(text);
}

}  // namespace ergodome
