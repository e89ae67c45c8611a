#include "render/lens/grid/hanging_nodes.h"

#include <algorithm>
#include <bit>

namespace ergodome {

namespace {

//! A node inside the side of a larger leaf: the nodes at the ends of the side, the node's relative
//! position `t` between them, the side's length (γ [turns] or s) and its axis (0: γ, 1: s).
struct HangingNode {
  int node;
  int ends[2];
  float t;
  float length;
  int axis;
  //! Number of halvings after which the node exists; nodes with fewer are corrected first.
  int refinement;
};

//! Returns the number of halvings of a root cell after which a coordinate is on a cell border.
int level(int position) {
  const auto bits = static_cast<std::uint32_t>(position % finest_a_root);
  return bits == 0 ? 0 : std::countr_zero(static_cast<std::uint32_t>(finest_a_root)) - std::countr_zero(bits);
}

//! Collects the nodes inside the sides of leaves.
class Finder {
 public:
  Finder(const LensStation& station, const NodeByPosition& nodes) : station_(station), nodes_(nodes) {}

  void search_along(const NodePosition& from, int axis, int extent) {
    const int last = axis == 0 ? from.gamma + extent : from.s + extent;
    const NodePosition to =
        axis == 0 ? node_position(station_, last, from.s) : node_position(station_, from.gamma, last);
    side_[0] = nodes_.at(from.key());
    side_[1] = nodes_.at(to.key());
    extent_ = extent;
    axis_ = axis;
    halve(from, 0, extent);
  }

  std::vector<HangingNode> found;

 private:
  void halve(const NodePosition& from, int begin, int end) {
    const int middle = (begin + end) / 2;
    if (middle == begin) {
      return;
    }
    const NodePosition position = axis_ == 0 ? node_position(station_, from.gamma + middle, from.s)
                                             : node_position(station_, from.gamma, from.s + middle);
    const auto at = nodes_.find(position.key());
    if (at == nodes_.end()) {
      return;
    }
    const int columns = station_.mirrored ? 2 * station_.columns : station_.columns;
    const float unit = 1.0F / static_cast<float>((axis_ == 0 ? columns : station_.rows) * finest_a_root);
    found.push_back({at->second,
                     {side_[0], side_[1]},
                     static_cast<float>(middle) / static_cast<float>(extent_),
                     static_cast<float>(extent_) * unit,
                     axis_,
                     level(position.gamma) + level(position.s)});
    halve(from, begin, middle);
    halve(from, middle, end);
  }

  const LensStation& station_;
  const NodeByPosition& nodes_;
  int side_[2] = {0, 0};
  int extent_ = 0;
  int axis_ = 0;
};

void mend(std::vector<float>& nodes, const HangingNode& hanging) {
  float* node = nodes.data() + floats_a_node * static_cast<std::size_t>(hanging.node);
  const float* begin = nodes.data() + floats_a_node * static_cast<std::size_t>(hanging.ends[0]);
  const float* end = nodes.data() + floats_a_node * static_cast<std::size_t>(hanging.ends[1]);
  float basis[4];
  float slope[4];
  hermite_basis(hanging.t, basis, slope);
  // Pairs of a value and its derivative along the side: along γ, (value, derivative along γ) and
  // (derivative along s, mixed derivative); along s, (value, derivative along s) and (derivative
  // along γ, mixed derivative).
  const int rate = hanging.axis == 0 ? 4 : 8;
  const int other = hanging.axis == 0 ? 8 : 4;
  for (const int from : {0, other}) {
    for (int c = 0; c < 3; ++c) {
      const int value = from + c;
      const float sum = basis[0] * begin[value] + basis[2] * end[value] +
                        hanging.length * (basis[1] * begin[value + rate] + basis[3] * end[value + rate]);
      const float rise = (slope[0] * begin[value] + slope[2] * end[value]) / hanging.length +
                         slope[1] * begin[value + rate] + slope[3] * end[value + rate];
      node[value] = sum;
      node[value + rate] = rise;
    }
  }
}

}  // namespace

NodePosition node_position(const LensStation& station, int gamma, int s) {
  const int round = station.columns * finest_a_root;
  return {station.mirrored || gamma < round ? gamma : gamma - round, s};
}

NodePosition corner_position(const LensStation& station, const CellBox& box, int corner) {
  return node_position(station, box.gamma + (corner & 1) * box.width, box.s + (corner >> 1) * box.height);
}

void mend_hanging_nodes(LensStation& station, const NodeByPosition& nodes, const std::vector<CellBox>& boxes) {
  Finder finder(station, nodes);
  for (const CellBox& box : boxes) {
    finder.search_along(corner_position(station, box, 0), 0, box.width);
    finder.search_along(corner_position(station, box, 2), 0, box.width);
    finder.search_along(corner_position(station, box, 0), 1, box.height);
    finder.search_along(corner_position(station, box, 1), 1, box.height);
  }
  std::stable_sort(finder.found.begin(), finder.found.end(),
                   [](const HangingNode& a, const HangingNode& b) { return a.refinement < b.refinement; });
  for (std::vector<float>* values : {&station.nodes, &station.nodes_along_r, &station.nodes_along_theta,
                                     &station.nodes_along_r_r, &station.nodes_along_r_theta}) {
    for (const HangingNode& hanging : finder.found) {
      if (!values->empty()) {
        mend(*values, hanging);
      }
    }
  }
}

}  // namespace ergodome
