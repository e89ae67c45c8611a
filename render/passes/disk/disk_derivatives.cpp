#include "render/passes/disk/disk_derivatives.h"

#include <algorithm>
#include <cmath>

#include "kernels/core/angles.h"
#include "kernels/spacetime/kerr/kerr.h"
#include "render/lens/stations/lens_position.h"
#include "render/passes/disk/disk_grid_tracer.h"

namespace ergodome {

namespace {

constexpr double longest_disk_step = 0.01;
//! Minimum step of the differences [rad]; with smaller steps, they are dominated by rounding errors
//! of float.
constexpr double shortest_disk_step = 1e-4;

//! Positions of a grid's nodes in its chart.
struct DiskNodePositions {
  std::vector<float> gamma_turns;
  std::vector<float> s;
};

DiskNodePositions node_positions(const DiskStation& station) {
  DiskNodePositions positions = {std::vector<float>(station.node_count()), std::vector<float>(station.node_count())};
  const std::vector<LeafBox> boxes = leaf_boxes(station.cells);
  for (std::size_t i = 0; i < station.cells.leaves.size(); ++i) {
    const LeafBox& box = boxes[i / 4];
    const auto node = static_cast<std::size_t>(station.cells.leaves[i]);
    positions.gamma_turns[node] = static_cast<float>(box.gamma_turns + (i % 2 == 1 ? box.width_turns : 0.0));
    positions.s[node] = static_cast<float>(box.s + (i % 4 >= 2 ? box.height : 0.0));
  }
  return positions;
}

//! Computes the difference quotients of the nodes between two camera positions, for each set of
//! nodes (DiskStation::NodeSets).
class DiskDifference {
 public:
  DiskDifference(const DiskStation& station, const DiskGridSettings& settings)
      : station_(station), settings_(settings), positions_(node_positions(station)) {}

  void take(const LensPosition& from, const LensPosition& to, double distance, DiskStation::NodeSets& change) {
    DiskStation::NodeSets before;
    trace(from, before);
    trace(to, change);
    const auto per_distance = static_cast<float>(1.0 / distance);
    for (int set = 0; set < station_.sets(); ++set) {
      std::ranges::transform(change[set], before[set], change[set].begin(),
                             [&](float b, float a) { return per_distance * (b - a); });
    }
  }

 private:
  void trace(const LensPosition& position, DiskStation::NodeSets& nodes) {
    const DiskChartCamera at(station_.cells.spacetime, position, settings_);
    tracer_.begin(at.camera, {}, settings_.pixel, {});
    tracer_.add_nodes(positions_.gamma_turns, positions_.s);
    for (int set = 0; set < station_.sets(); ++set) {
      nodes[set] = tracer_.nodes(set);
    }
  }

  const DiskStation& station_;
  const DiskGridSettings& settings_;
  DiskNodePositions positions_;
  DiskGridTracer tracer_;
};

}  // namespace

void add_disk_derivatives(DiskStation& station, const DiskGridSettings& settings) {
  const LensStation& cells = station.cells;
  DiskDifference difference(station, settings);
  const double dr = longest_disk_step * radial_measure(cells.spacetime, cells.r);
  difference.take({cells.r - dr, cells.theta}, {cells.r + dr, cells.theta}, 2.0 * dr, station.nodes_along_r);
  const double step = std::min(0.5 * std::abs(cells.theta - 0.5 * pi), longest_disk_step);
  if (step < shortest_disk_step) {
    for (int set = 0; set < station.sets(); ++set) {
      station.nodes_along_theta[set].assign(station.nodes[set].size(), 0.0F);
    }
    return;
  }
  const double north = std::max(cells.theta - step, 0.0);
  const double south = std::min(cells.theta + step, pi);
  difference.take({cells.r, north}, {cells.r, south}, south - north, station.nodes_along_theta);
}

void add_moved_nodes(const DiskStation& station, const LensPosition& offset, int set, float part,
                     std::vector<float>& sum) {
  const float* const nodes = station.nodes[set].data();
  if (!station.has_derivatives()) {
    for (std::size_t i = 0; i < sum.size(); ++i) {
      sum[i] += part * nodes[i];
    }
    return;
  }
  const float* const along_r = station.nodes_along_r[set].data();
  const float* const along_theta = station.nodes_along_theta[set].data();
  const float dr = part * static_cast<float>(offset.r);
  const float dtheta = part * static_cast<float>(offset.theta);
  for (std::size_t i = 0; i < sum.size(); ++i) {
    sum[i] += part * nodes[i] + dr * along_r[i] + dtheta * along_theta[i];
  }
}

}  // namespace ergodome
