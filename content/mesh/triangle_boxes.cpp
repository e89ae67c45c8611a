#include "content/mesh/triangle_boxes.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "kernels/launch/parallel_for.h"

namespace ergodome {

namespace {

constexpr std::uint32_t leaf_triangles = 4;
constexpr int bin_count = 16;
//! Subtrees of at most max(min_part, triangles / max_parts) triangles are built in parallel. About
//! max_parts of them keep all threads equally busy; smaller ones are not worth a task.
constexpr std::size_t max_parts = 256;
constexpr std::size_t min_part = 4096;
//! From this depth on, nodes are halved by triangle count, which keeps any mesh within
//! `deepest_tree`.
constexpr int deepest_by_area = deepest_tree - 34;

struct Box {
  float low[3] = {std::numeric_limits<float>::max(), std::numeric_limits<float>::max(),
                  std::numeric_limits<float>::max()};
  float high[3] = {std::numeric_limits<float>::lowest(), std::numeric_limits<float>::lowest(),
                   std::numeric_limits<float>::lowest()};

  void add(const float* point) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], point[axis]);
      high[axis] = std::max(high[axis], point[axis]);
    }
  }
  void add(const Box& box) {
    add(box.low);
    add(box.high);
  }
  [[nodiscard]] double half_area() const {
    const double x = std::max(0.0, static_cast<double>(high[0]) - static_cast<double>(low[0]));
    const double y = std::max(0.0, static_cast<double>(high[1]) - static_cast<double>(low[1]));
    const double z = std::max(0.0, static_cast<double>(high[2]) - static_cast<double>(low[2]));
    return x * y + y * z + z * x;
  }
};

//! A triangle during the construction of the tree.
struct Item {
  Box box;
  float middle[3];
  std::uint32_t triangle;
};

using ItemIterator = std::vector<Item>::iterator;

//! A cut of a node across an axis, into a near part (smaller coordinates) and a far part.
struct Cut {
  int axis = -1;
  int bin = 0;  //!< the first bin of the far part
  double cost = std::numeric_limits<double>::max();
};

struct Binning {
  float low;
  float scale;

  [[nodiscard]] int bin(float position) const {
    return std::clamp(static_cast<int>((position - low) * scale), 0, bin_count - 1);
  }
};

Binning binning(const Box& middles, int axis) {
  const float width = middles.high[axis] - middles.low[axis];
  return {middles.low[axis], static_cast<float>(bin_count) / width};
}

//! Replaces `best` by the best cut across one axis, if that is better.
void find_cut(ItemIterator begin, ItemIterator end, const Box& middles, int axis, Cut& best) {
  if (!(middles.high[axis] - middles.low[axis] > 0.0F) || !std::isfinite(binning(middles, axis).scale)) {
    return;
  }
  const Binning bins = binning(middles, axis);
  Box boxes[bin_count];
  long counts[bin_count] = {};
  for (ItemIterator item = begin; item != end; ++item) {
    const int bin = bins.bin(item->middle[axis]);
    boxes[bin].add(item->box);
    ++counts[bin];
  }
  double far_cost[bin_count] = {};
  Box far_box;
  long far_count = 0;
  for (int bin = bin_count - 1; bin > 0; --bin) {
    far_box.add(boxes[bin]);
    far_count += counts[bin];
    far_cost[bin] = far_box.half_area() * static_cast<double>(far_count);
  }
  Box near_box;
  long near_count = 0;
  for (int bin = 1; bin < bin_count; ++bin) {
    near_box.add(boxes[bin - 1]);
    near_count += counts[bin - 1];
    const double cost = near_box.half_area() * static_cast<double>(near_count) + far_cost[bin];
    if (near_count > 0 && near_count < end - begin && cost < best.cost) {
      best = {axis, bin, cost};
    }
  }
}

//! Divides the items of a node into two nonempty parts. Returns the beginning of the second.
ItemIterator part_items(ItemIterator begin, ItemIterator end, int depth) {
  Box middles;
  for (ItemIterator item = begin; item != end; ++item) {
    middles.add(item->middle);
  }
  Cut cut;
  for (int axis = 0; axis < 3 && depth < deepest_by_area; ++axis) {
    find_cut(begin, end, middles, axis, cut);
  }
  if (cut.axis >= 0) {
    const Binning bins = binning(middles, cut.axis);
    return std::partition(begin, end, [&](const Item& item) { return bins.bin(item.middle[cut.axis]) < cut.bin; });
  }
  int axis = 0;
  for (int other = 1; other < 3; ++other) {
    axis = middles.high[other] - middles.low[other] > middles.high[axis] - middles.low[axis] ? other : axis;
  }
  const ItemIterator half = begin + (end - begin) / 2;
  std::nth_element(begin, half, end, [axis](const Item& a, const Item& b) { return a.middle[axis] < b.middle[axis]; });
  return half;
}

//! Calls each(i) for i from 0 to count - 1, on all threads.
template <class Each>
void for_each_on_all_threads(std::size_t count, const Each& each) {
  parallel_for(static_cast<int>(count), 4096, [&](int begin, int end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      each(i);
    }
  });
}

std::vector<Item> items_of(const TriangleMesh& mesh) {
  std::vector<Item> items(static_cast<std::size_t>(mesh.triangle_count()));
  for_each_on_all_threads(items.size(), [&](std::size_t i) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      items[i].box.add(mesh.vertices[mesh.indices[3 * i + corner]].position);
    }
    for (int axis = 0; axis < 3; ++axis) {
      items[i].middle[axis] = 0.5F * items[i].box.low[axis] + 0.5F * items[i].box.high[axis];
    }
    items[i].triangle = static_cast<std::uint32_t>(i);
  });
  return items;
}

//! A node whose box and children have not been built yet.
struct Open {
  std::size_t node;
  std::size_t begin, end;
  int depth;
};

//! Builds the open node and all nodes below it, except for nodes for which left(open) returns true.
template <class Left>
void make_nodes_below(std::vector<Item>& items, const Open& from, std::vector<TreeNode>& nodes, const Left& left) {
  std::vector<Open> open = {from};
  while (!open.empty()) {
    const Open now = open.back();
    open.pop_back();
    if (left(now)) {
      continue;
    }
    Box box;
    for (std::size_t i = now.begin; i < now.end; ++i) {
      box.add(items[i].box);
    }
    TreeNode node = {{box.low[0], box.low[1], box.low[2]},
                     static_cast<std::uint32_t>(now.begin),
                     {box.high[0], box.high[1], box.high[2]},
                     static_cast<std::uint32_t>(now.end - now.begin)};
    if (node.count > leaf_triangles) {
      const auto begin = items.begin() + static_cast<std::ptrdiff_t>(now.begin);
      const auto end = items.begin() + static_cast<std::ptrdiff_t>(now.end);
      const std::size_t cut = static_cast<std::size_t>(part_items(begin, end, now.depth) - items.begin());
      node.first = static_cast<std::uint32_t>(nodes.size());
      node.count = 0;
      open.push_back({nodes.size(), now.begin, cut, now.depth + 1});
      open.push_back({nodes.size() + 1, cut, now.end, now.depth + 1});
      nodes.resize(nodes.size() + 2);
    }
    nodes[now.node] = node;
  }
}

//! Replaces a node by the root of a separately built tree, and appends the other nodes of that
//! tree.
void put_in_place(const std::vector<TreeNode>& tree, std::size_t node, std::vector<TreeNode>& nodes) {
  const auto beyond = static_cast<std::uint32_t>(nodes.size() - 1);
  const auto moved = [beyond](TreeNode from) {
    from.first += from.count == 0 ? beyond : 0;
    return from;
  };
  nodes[node] = moved(tree.front());
  std::transform(tree.begin() + 1, tree.end(), std::back_inserter(nodes), moved);
}

//! Builds the top of the tree serially and its subtrees on all threads. The order of the nodes is
//! deterministic.
std::vector<TreeNode> make_nodes(std::vector<Item>& items) {
  const std::size_t part = std::max(min_part, items.size() / max_parts);
  std::vector<TreeNode> nodes(1);
  std::vector<Open> parts;
  make_nodes_below(items, {0, 0, items.size(), 0}, nodes, [&](const Open& open) {
    const bool small = open.end - open.begin <= part;
    if (small) {
      parts.push_back(open);
    }
    return small;
  });
  std::vector<std::vector<TreeNode>> trees(parts.size(), std::vector<TreeNode>(1));
  parallel_for(static_cast<int>(parts.size()), 1, [&](int begin, int end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      Open whole = parts[i];
      whole.node = 0;
      make_nodes_below(items, whole, trees[i], [](const Open&) { return false; });
    }
  });
  nodes.reserve(items.size() / 2 + 1);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    put_in_place(trees[i], parts[i].node, nodes);
  }
  return nodes;
}

}  // namespace

TriangleBoxes build_triangle_tree(const TriangleMesh& mesh) {
  std::vector<Item> items = items_of(mesh);
  TriangleBoxes boxes;
  boxes.nodes = make_nodes(items);
  boxes.triangles.resize(items.size());
  boxes.corners.resize(9 * items.size());
  for_each_on_all_threads(items.size(), [&](std::size_t i) {
    boxes.triangles[i] = items[i].triangle;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const float* const p = mesh.vertices[mesh.indices[3 * std::size_t{items[i].triangle} + corner]].position;
      std::copy_n(p, 3, boxes.corners.begin() + static_cast<std::ptrdiff_t>(9 * i + 3 * corner));
    }
  });
  const TreeNode& root = boxes.nodes.front();
  const auto between = [&](int axis) {
    return 0.5 * (static_cast<double>(root.low[axis]) + static_cast<double>(root.high[axis]));
  };
  boxes.middle = {between(0), between(1), between(2)};
  for (std::size_t i = 0; i < boxes.corners.size(); i += 3) {
    const auto part = [&](std::size_t k) { return static_cast<double>(boxes.corners[i + k]); };
    const Vector3<double> from_middle = Vector3<double>{part(0), part(1), part(2)} - boxes.middle;
    boxes.radius = std::max(boxes.radius, std::sqrt(dot(from_middle, from_middle)));
  }
  return boxes;
}

}  // namespace ergodome
