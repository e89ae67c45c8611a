#include "render/passes/disk/joined_disk.h"

#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "render/lens/grid/hanging_nodes.h"

namespace ergodome {

namespace {

//! A cell of a station's tree that is reached during a descent.
struct TreeCursor {
  int slot;
  CellBox box;

  //! Descends in the tree as long as `cell` is inside one child. Returns the axis along which the
  //! tree then splits `cell`, or -1 if `cell` is inside a leaf.
  int descend_to(const CellBox& cell, const std::vector<int>& tree) {
    for (int entry = tree[static_cast<std::size_t>(slot)]; entry >= 0; entry = tree[static_cast<std::size_t>(slot)]) {
      const int axis = entry & 1;
      int& begin = axis == 0 ? box.gamma : box.s;
      int& extent = axis == 0 ? box.width : box.height;
      const int from = axis == 0 ? cell.gamma : cell.s;
      const int to = from + (axis == 0 ? cell.width : cell.height);
      const int middle = begin + extent / 2;
      if (extent < 2) {
        return -1;
      }
      if (from < middle && to > middle) {
        return axis;
      }
      extent /= 2;
      begin = from < middle ? begin : middle;
      slot = (entry >> 1) + (from < middle ? 0 : 1);
    }
    return -1;
  }
};

//! A leaf of a station's tree. Only untrusted files can have leaves that are smaller than a cell
//! of integer size 1 (CellBox). In such a cell, the first leaf is used instead of all of them.
struct StationLeaf {
  std::size_t number;
  bool flagged;
};

StationLeaf leaf_at(const std::vector<int>& tree, int slot) {
  int entry = tree[static_cast<std::size_t>(slot)];
  while (entry >= 0) {
    entry = tree[static_cast<std::size_t>(entry >> 1)];
  }
  const int code = -1 - entry;
  return {static_cast<std::size_t>(code >> 1), (code & 1) != 0};
}

//! Evaluates the bicubic patch of a cell at a position, as a node: value, derivatives along γ and
//! s, and the mixed derivative.
class PatchNode {
 public:
  //! `u`, `v`: position in the cell, in [0, 1]; `width_turns`, `height`: size of the cell.
  PatchNode(float u, float v, float width_turns, float height) {
    float basis_u[4];
    float slope_u[4];
    float basis_v[4];
    float slope_v[4];
    hermite_basis(u, basis_u, slope_u);
    hermite_basis(v, basis_v, slope_v);
    for (int i = 0; i < 4; ++i) {
      // The derivatives of nodes are per unit of γ [turns] and s, those of the basis functions per
      // width and height of the cell.
      const float node_u = i % 2 == 0 ? 1.0F : width_turns;
      const float node_v = i % 2 == 0 ? 1.0F : height;
      along_u_[0][i] = node_u * basis_u[i];
      along_u_[1][i] = node_u * slope_u[i] / width_turns;
      along_v_[0][i] = node_v * basis_v[i];
      along_v_[1][i] = node_v * slope_v[i] / height;
    }
  }

  void read(const std::vector<float>& nodes, const int* corners, float* into) const {
    for (std::size_t part = 0; part < floats_a_node; ++part) {
      const auto& along_u = along_u_[part / 4 % 2];
      const auto& along_v = along_v_[part / 8];
      float sum = 0.0F;
      for (int corner = 0; corner < 4; ++corner) {
        const float* const node = nodes.data() + floats_a_node * static_cast<std::size_t>(corners[corner]) + part % 4;
        const int i = 2 * (corner & 1);
        const int j = 2 * (corner >> 1);
        sum += along_v[j] * (along_u[i] * node[0] + along_u[i + 1] * node[4]) +
               along_v[j + 1] * (along_u[i] * node[8] + along_u[i + 1] * node[12]);
      }
      into[part] = sum;
    }
  }

 private:
  float along_u_[2][4];  //!< values of the basis functions along γ at u, and their derivatives by γ
  float along_v_[2][4];
};

//! Maximum number of tree entries. Bakes have a few thousand cells; more come only from untrusted
//! files.
constexpr std::size_t max_joined_entries = std::size_t{1} << 19U;

//! Builds the joined layers of two stations.
class Joiner {
 public:
  Joiner(const DiskStation& first, const DiskStation& second) : stations_{&first, &second} {
    joined_.first = described(first);
    joined_.second = described(second);
  }

  std::optional<JoinedDisk> join() {
    LensStation& cells = joined_.first.cells;
    std::vector<Open> open;
    for (int slot = 0; slot < cells.columns * cells.rows; ++slot) {
      const CellBox box = {slot % cells.columns * finest_a_root, slot / cells.columns * finest_a_root, finest_a_root,
                           finest_a_root};
      open.push_back({box, slot, {TreeCursor{slot, box}, TreeCursor{slot, box}}});
      cells.tree.push_back(0);
    }
    while (!open.empty()) {
      Open cell = open.back();
      open.pop_back();
      int axis = cell.at[0].descend_to(cell.box, stations_[0]->cells.tree);
      axis = axis >= 0 ? axis : cell.at[1].descend_to(cell.box, stations_[1]->cells.tree);
      if (axis >= 0) {
        split(cell, axis, open);
      } else {
        make_leaf(cell);
      }
      if (cells.tree.size() > max_joined_entries) {
        return std::nullopt;
      }
    }
    return std::move(joined_);
  }

 private:
  //! A cell to be processed: its index in the joined tree, and the corresponding positions in both
  //! stations' trees.
  struct Open {
    CellBox box;
    int slot;
    std::array<TreeCursor, 2> at;
  };

  //! Returns a copy of a station without cells and nodes.
  static DiskStation described(const DiskStation& station) {
    DiskStation like;
    like.cells = station.cells;
    like.cells.tree.clear();
    like.cells.leaves.clear();
    like.cells.leaf_error_px.clear();
    like.inner_r = station.inner_r;
    like.outer_r = station.outer_r;
    like.pattern = station.pattern;
    return like;
  }

  void split(const Open& cell, int axis, std::vector<Open>& open) {
    std::vector<int>& tree = joined_.first.cells.tree;
    const auto children = static_cast<int>(tree.size());
    tree[static_cast<std::size_t>(cell.slot)] = 2 * children + axis;
    tree.insert(tree.end(), 2, 0);
    Open child = cell;
    (axis == 0 ? child.box.width : child.box.height) /= 2;
    child.slot = children;
    open.push_back(child);
    (axis == 0 ? child.box.gamma : child.box.s) += axis == 0 ? child.box.width : child.box.height;
    child.slot = children + 1;
    open.push_back(child);
  }

  void make_leaf(const Open& cell) {
    LensStation& cells = joined_.first.cells;
    const auto leaf = static_cast<int>(cells.leaf_count());
    unsigned orders = 0;
    bool flagged = false;
    std::array<StationLeaf, 2> within;
    for (std::size_t i = 0; i < 2; ++i) {
      within[i] = leaf_at(stations_[i]->cells.tree, cell.at[i].slot);
      orders |= stations_[i]->orders[within[i].number];
      flagged = flagged || within[i].flagged;
    }
    for (int corner = 0; corner < 4; ++corner) {
      const NodePosition position = corner_position(cells, cell.box, corner);
      const auto [found, fresh] =
          node_by_position_.try_emplace(position.key(), static_cast<int>(node_by_position_.size()));
      if (fresh) {
        add_node();
      }
      read_node(cell, corner, within, static_cast<std::size_t>(found->second));
      cells.leaves.push_back(found->second);
    }
    cells.tree[static_cast<std::size_t>(cell.slot)] = -1 - (2 * leaf + (flagged ? 1 : 0));
    cells.leaf_error_px.push_back(0.0F);
    joined_.first.orders.push_back(static_cast<unsigned char>(orders));
  }

  //! Appends a node whose values are not yet known.
  void add_node() {
    for (std::size_t i = 0; i < 2; ++i) {
      DiskStation& to = i == 0 ? joined_.first : joined_.second;
      sources_[i].push_back(unknown_source);
      for (int set = 0; set < to.sets(); ++set) {
        to.nodes[set].resize(to.nodes[set].size() + floats_a_node);
        if (stations_[i]->has_derivatives()) {
          to.nodes_along_r[set].resize(to.nodes[set].size());
          to.nodes_along_theta[set].resize(to.nodes[set].size());
        }
      }
    }
  }

  //! Interpolates both stations at a corner of a cell. In the middle of a larger leaf's side,
  //! leaves of different sizes may give different values: those of the smaller leaf are preferred,
  //! and values of a node of the station are preferred to all others.
  void read_node(const Open& cell, int corner, const std::array<StationLeaf, 2>& within, std::size_t node) {
    const int gamma = cell.box.gamma + (corner & 1) * cell.box.width;
    const int s = cell.box.s + (corner >> 1) * cell.box.height;
    for (std::size_t i = 0; i < 2; ++i) {
      const DiskStation& from = *stations_[i];
      DiskStation& to = i == 0 ? joined_.first : joined_.second;
      const CellBox& box = cell.at[i].box;
      const bool own =
          (gamma == box.gamma || gamma == box.gamma + box.width) && (s == box.s || s == box.s + box.height);
      const long source = own ? 0 : static_cast<long>(box.width) * box.height;
      if (source >= sources_[i][node]) {
        continue;
      }
      sources_[i][node] = source;
      const auto part = [](int value, int begin, int extent) {
        return static_cast<float>(value - begin) / static_cast<float>(extent);
      };
      const auto turn = static_cast<float>((from.cells.mirrored ? 2 : 1) * from.cells.columns * finest_a_root);
      const auto height = static_cast<float>(from.cells.rows * finest_a_root);
      const PatchNode at(part(gamma, box.gamma, box.width), part(s, box.s, box.height),
                         static_cast<float>(box.width) / turn, static_cast<float>(box.height) / height);
      const int* const corners = from.cells.leaves.data() + 4 * within[i].number;
      const auto read = [&](const DiskStation::NodeSets& nodes, DiskStation::NodeSets& into) {
        for (int set = 0; set < from.sets(); ++set) {
          at.read(nodes[set], corners, into[set].data() + floats_a_node * node);
        }
      };
      read(from.nodes, to.nodes);
      if (from.has_derivatives()) {
        read(from.nodes_along_r, to.nodes_along_r);
        read(from.nodes_along_theta, to.nodes_along_theta);
      }
    }
  }

  static constexpr long unknown_source = std::numeric_limits<long>::max();

  std::array<const DiskStation*, 2> stations_;
  JoinedDisk joined_;
  NodeByPosition node_by_position_;
  //! For each node, the area of the leaf in which it was interpolated; 0 if it is a node of the
  //! station.
  std::array<std::vector<long>, 2> sources_;
};

bool can_join(const DiskStation& first, const DiskStation& second) {
  const LensStation& a = first.cells;
  const LensStation& b = second.cells;
  return a.spacetime == b.spacetime && a.mirrored == b.mirrored && a.columns == b.columns && a.rows == b.rows &&
         first.pattern == second.pattern && first.inner_r == second.inner_r && first.outer_r == second.outer_r &&
         first.has_derivatives() == second.has_derivatives();
}

}  // namespace

std::optional<JoinedDisk> join(const DiskStation& first, const DiskStation& second) {
  return can_join(first, second) ? Joiner(first, second).join() : std::nullopt;
}

}  // namespace ergodome
