#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "calibration/formats/warps/foreign_warp.h"
#include "calibration/formats/warps/triangle_warp.h"
#include "calibration/formats/warps/warp_text.h"

namespace ergodome {

namespace {

constexpr std::size_t csv_fields = 6;
using CsvFields = std::array<std::string_view, csv_fields>;

std::string_view without_blanks(std::string_view text) {
  std::string_view rest = text;
  const std::string_view word = take_word(rest);
  return take_word(rest).empty() ? word : text;
}

class DomeprojectionParser {
 public:
  DomeprojectionParser(std::string_view text, const std::string& file) : text_(text, file), file_(file) {}

  ForeignWarp parse() {
    while (const auto line = text_.next()) {
      if (!line->starts_with('#') && !is_head(*line)) {
        read_node(*line);
      }
    }
    return {in_reading_order(grid()), std::nullopt, {}};
  }

 private:
  struct PlacedNode {
    int column;
    int row;
    WarpNode node;
  };

  //! Returns true if a line is the first one and names the columns; throws Error if it names other
  //! columns. Determines the separator from the first line.
  bool is_head(std::string_view line) {
    if (started_) {
      return false;
    }
    started_ = true;
    for (const char c : {',', '\t', ';'}) {
      constexpr auto gaps = static_cast<std::ptrdiff_t>(csv_fields) - 1;
      separator_ = std::ranges::count(line, c) >= gaps ? c : separator_;
    }
    std::string names(line);
    std::erase_if(names, [](unsigned char c) { return c <= ' ' && c != '\t'; });
    std::ranges::transform(names, names.begin(), [this](unsigned char c) {
      return c == static_cast<unsigned char>(separator_) ? ';' : static_cast<char>(std::tolower(c));
    });
    if (names == "x;y;u;v;column;row" || names == "x;y;u;v;col;row") {
      return true;
    }
    if (!names.empty() && std::isalpha(static_cast<unsigned char>(names[0])) != 0 && !names.starts_with("nan") &&
        !names.starts_with("inf")) {
      throw text_.error(
          fmt::format("is not a flat domeprojection warp, because its columns are \"{}\"", shown_of(names)),
          "export a flat warp with the columns x;y;u;v;column;row");
    }
    return false;
  }

  CsvFields fields_of(std::string_view line) const {
    CsvFields fields;
    std::size_t count = 0;
    while (true) {
      const std::size_t end = line.find(separator_);
      if (count < csv_fields) {
        fields[count] = without_blanks(line.substr(0, end));
      }
      ++count;
      if (end == std::string_view::npos) {
        break;
      }
      line.remove_prefix(end + 1);
    }
    if (count != csv_fields) {
      throw text_.error(fmt::format("has {} values instead of 6", count), "write x;y;u;v;column;row");
    }
    return fields;
  }

  void read_node(std::string_view line) {
    if (nodes_.size() >= max_mesh_nodes) {
      throw text_.error(fmt::format("has more than {} nodes", max_mesh_nodes), "export a coarser mesh");
    }
    const CsvFields fields = fields_of(line);
    WarpNode node;
    node.x = static_cast<float>(text_.number(fields[0], "x"));
    node.y = static_cast<float>(text_.number(fields[1], "y"));
    node.u = static_cast<float>(text_.number(fields[2], "u"));
    node.v = static_cast<float>(text_.number(fields[3], "v"));
    const auto column = static_cast<int>(text_.whole(fields[4], "the column", 0, max_mesh_side - 1));
    const auto row = static_cast<int>(text_.whole(fields[5], "the row", 0, max_mesh_side - 1));
    columns_ = std::max(columns_, column + 1);
    rows_ = std::max(rows_, row + 1);
    nodes_.push_back({column, row, node});
  }

  WarpMesh grid() const {
    check_mesh_size(columns_, rows_, file_);
    const std::size_t positions = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
    // Nodes may be missing for parts that the projector does not show, but meshes in which almost
    // all are missing are refused.
    constexpr std::size_t max_positions_per_node = 16;
    if (positions / max_positions_per_node > nodes_.size()) {
      throw Error(file_, fmt::format("has {} nodes for {} columns and {} rows", nodes_.size(), columns_, rows_),
                  "the file is truncated or damaged; export it again");
    }
    WarpNode hole;
    hole.valid = false;
    WarpMesh mesh{MeshTopology::rectangular, columns_, rows_, std::vector<WarpNode>(positions, hole)};
    for (const PlacedNode& placed : nodes_) {
      WarpNode& node = mesh.at(placed.column, placed.row);
      if (node.valid) {
        throw Error(file_, fmt::format("has two nodes in column {}, row {}", placed.column, placed.row),
                    "export it again");
      }
      node = placed.node;
    }
    return mesh;
  }

  WarpText text_;
  std::string file_;
  bool started_ = false;
  char separator_ = ';';
  int columns_ = 0;
  int rows_ = 0;
  std::vector<PlacedNode> nodes_;
};

}  // namespace

ForeignWarp parse_domeprojection_warp(std::string_view text, const std::string& file) {
  return DomeprojectionParser(text, file).parse();
}

}  // namespace ergodome
