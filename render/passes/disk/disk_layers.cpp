#include "render/passes/disk/disk_layers.h"

#include <utility>
#include <vector>

#include "render/passes/disk/disk_derivatives.h"

namespace ergodome {

namespace {

constexpr const char* moved_disk_buffer = "disk grid at a position between stations";

LensPosition disk_position_of(const DiskStation& station) { return {station.cells.r, station.cells.theta}; }

//! Returns how two stations are blended at a position: by a cubic if they have derivatives along
//! the camera's r and θ, otherwise linearly.
CubicMix mix_of(const JoinedDisk& stations, const LensPosition& position) {
  const LensPosition first = disk_position_of(stations.first);
  const LensPosition second = disk_position_of(stations.second);
  return stations.first.has_derivatives() ? cubic_mix(first, second, position)
                                          : CubicMix{{}, position_weight(first, second, position)};
}

}  // namespace

DiskLayers::DiskLayers(std::shared_ptr<const DiskStation> station, const LensPosition& position)
    : cells_(std::move(station)) {
  const LensPosition from = disk_position_of(*cells_);
  if (same_position(from, position)) {
    return;
  }
  set_edge(position);
  for (int set = 0; set < cells_->sets(); ++set) {
    std::vector<float> nodes(cells_->nodes[set].size());
    add_moved_nodes(*cells_, {position.r - from.r, position.theta - from.theta}, set, 1.0F, nodes);
    keep(set, nodes);
  }
}

DiskLayers::DiskLayers(std::shared_ptr<const JoinedDisk> stations, const LensPosition& position)
    : cells_(stations, &stations->first) {
  set_edge(position);
  const CubicMix mix = mix_of(*stations, position);
  const auto weight = static_cast<float>(mix.second_weight);
  for (int set = 0; set < cells_->sets(); ++set) {
    std::vector<float> nodes(cells_->nodes[set].size());
    add_moved_nodes(stations->first, mix.offsets[0], set, 1.0F - weight, nodes);
    add_moved_nodes(stations->second, mix.offsets[1], set, weight, nodes);
    keep(set, nodes);
  }
}

void DiskLayers::set_edge(const LensPosition& position) {
  edge_.emplace(Backend::cpu,
                make_camera_station(cells_->cells.spacetime, position.r, position.theta, 0.0, ObserverMotion::rain),
                edge_points);
}

void DiskLayers::keep(int set, const std::vector<float>& nodes) {
  nodes_[set] = Buffer<float>(Backend::cpu, nodes, moved_disk_buffer);
}

DiskGrid DiskLayers::view() const {
  DiskGrid grid = disk_grid_view(*cells_);
  if (edge_) {
    grid.cells.chart.edge = edge_->view();
  }
  for (int set = 0; set < layer_orders; ++set) {
    grid.nodes[set] = nodes_[set].size() > 0 ? nodes_[set].data() : grid.nodes[set];
  }
  return grid;
}

}  // namespace ergodome
