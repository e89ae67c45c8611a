#include <algorithm>
#include <cmath>

#include "calibration/warps/warp_conversion.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

//! A corner of a triangle in sample coordinates of the target: (0, 0) is the center of the first
//! sample.
struct Corner {
  double column;
  double row;
  const WarpNode* node;
};

class Resampler {
 public:
  Resampler(const WarpMesh& mesh, int width, int height) : mesh_(mesh) {
    check_mesh_size(width, height, "resampled warp");
    filled_.columns = width;
    filled_.rows = height;
    filled_.nodes.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (int row = 0; row < height; ++row) {
      for (int column = 0; column < width; ++column) {
        filled_.at(column, row) = {static_cast<float>(fill_position(column, width)),
                                   static_cast<float>(fill_position(row, height)),
                                   0.0F,
                                   0.0F,
                                   0.0F,
                                   false};
      }
    }
    tests_left_ =
        max_layers * static_cast<double>(filled_.nodes.size()) + 16.0 * static_cast<double>(mesh.nodes.size());
  }

  WarpMesh resample() {
    const int columns = mesh_.topology == MeshTopology::polar ? mesh_.columns : mesh_.columns - 1;
    for (int row = 0; row + 1 < mesh_.rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        fill_cell(column, (column + 1) % mesh_.columns, row);
      }
    }
    keep_nodes_in_place();
    return std::move(filled_);
  }

 private:
  //! Maximum number of tests whether a triangle covers a sample, per sample on average: cells that
  //! overlap more do not form an image and would take hours.
  static constexpr double max_layers = 64.0;

  [[nodiscard]] Corner corner(const WarpNode& node) const {
    return {node.x * static_cast<double>(filled_.columns) - 0.5, node.y * static_cast<double>(filled_.rows) - 0.5,
            &node};
  }

  void fill_cell(int left, int right, int top) {
    const WarpNode* nodes[] = {&mesh_.at(left, top), &mesh_.at(right, top), &mesh_.at(right, top + 1),
                               &mesh_.at(left, top + 1)};
    if (!std::all_of(std::begin(nodes), std::end(nodes), [](const WarpNode* node) { return node->valid; })) {
      return;
    }
    fill_triangle(corner(*nodes[0]), corner(*nodes[1]), corner(*nodes[2]));
    fill_triangle(corner(*nodes[0]), corner(*nodes[2]), corner(*nodes[3]));
  }

  void fill_triangle(const Corner& a, const Corner& b, const Corner& c) {
    const double area = (b.column - a.column) * (c.row - a.row) - (c.column - a.column) * (b.row - a.row);
    if (area == 0.0) {
      return;
    }
    // Triangles are enlarged by this much, so that rounding leaves no gaps between them.
    constexpr double slack = 1e-4;
    const auto [left, right] = std::minmax({a.column, b.column, c.column});
    const auto [top, bottom] = std::minmax({a.row, b.row, c.row});
    const int first_column = static_cast<int>(std::ceil(std::max(left - slack, 0.0)));
    const int last_column = static_cast<int>(std::floor(std::min(right + slack, filled_.columns - 1.0)));
    const int first_row = static_cast<int>(std::ceil(std::max(top - slack, 0.0)));
    const int last_row = static_cast<int>(std::floor(std::min(bottom + slack, filled_.rows - 1.0)));
    count_tests(first_column, last_column, first_row, last_row);
    for (int row = first_row; row <= last_row; ++row) {
      for (int column = first_column; column <= last_column; ++column) {
        const double at_b = ((column - a.column) * (c.row - a.row) - (c.column - a.column) * (row - a.row)) / area;
        const double at_c = ((b.column - a.column) * (row - a.row) - (column - a.column) * (b.row - a.row)) / area;
        if (at_b >= -slack && at_c >= -slack && at_b + at_c <= 1.0 + slack) {
          set(filled_.at(column, row), *a.node, *b.node, *c.node, at_b, at_c);
        }
      }
    }
  }

  void count_tests(int first_column, int last_column, int first_row, int last_row) {
    tests_left_ -= std::max(0.0, 1.0 + last_column - first_column) * std::max(0.0, 1.0 + last_row - first_row);
    if (tests_left_ < 0.0) {
      throw Error("", "the warp's cells overlap more than 64 times on average", "export the mesh again");
    }
  }

  static void set(WarpNode& target, const WarpNode& a, const WarpNode& b, const WarpNode& c, double at_b, double at_c) {
    const auto between = [&](float WarpNode::*part) {
      const double value = a.*part;
      return static_cast<float>(value + at_b * (static_cast<double>(b.*part) - value) +
                                at_c * (static_cast<double>(c.*part) - value));
    };
    target.u = between(&WarpNode::u);
    target.v = between(&WarpNode::v);
    target.intensity = std::max(between(&WarpNode::intensity), 0.0F);
    target.valid = true;
  }

  //! Sets samples that coincide with nodes to the nodes' values, also at the edge of the drawn
  //! area, where no cell with valid corners covers them.
  void keep_nodes_in_place() {
    constexpr double near = 1e-3;
    for (const WarpNode& node : mesh_.nodes) {
      const Corner at = corner(node);
      const double column = std::round(at.column);
      const double row = std::round(at.row);
      const bool inside = column >= 0.0 && column < filled_.columns && row >= 0.0 && row < filled_.rows;
      if (node.valid && inside && std::abs(at.column - column) < near && std::abs(at.row - row) < near) {
        WarpNode& target = filled_.at(static_cast<int>(column), static_cast<int>(row));
        target.u = node.u;
        target.v = node.v;
        target.intensity = node.intensity;
        target.valid = true;
      }
    }
  }

  const WarpMesh& mesh_;
  WarpMesh filled_;
  double tests_left_ = 0.0;
};

}  // namespace

WarpMesh resampled_warp(const WarpMesh& mesh, int width, int height) {
  return Resampler(mesh, width, height).resample();
}

}  // namespace ergodome
