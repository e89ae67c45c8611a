#include "render/passes/disk/disk_layers.h"

#include <utility>
#include <vector>

#include "render/passes/disk/disk_derivatives.h"

namespace ergodome {

namespace {

constexpr const char* moved_disk_buffer = "disk grid at a position between stations";

LensPlace disk_place_of(const DiskStation& station) { return {station.cells.r, station.cells.theta}; }

//! Returns how two stations are blended at a position: by a cubic if they have derivatives,
//! otherwise linearly.
CubicMix mix_of(const JoinedDisk& stations, const LensPlace& place) {
  const LensPlace first = disk_place_of(stations.first);
  const LensPlace second = disk_place_of(stations.second);
  return stations.first.has_derivatives() ? cubic_mix(first, second, place)
                                          : CubicMix{{}, place_weight(first, second, place)};
}

}  // namespace

DiskLayers::DiskLayers(std::shared_ptr<const DiskStation> station, const LensPlace& place)
    : cells_(std::move(station)) {
  const LensPlace from = disk_place_of(*cells_);
  if (same_place(from, place)) {
    return;
  }
  set_edge(place);
  for (int set = 0; set < cells_->sets(); ++set) {
    std::vector<float> nodes(cells_->nodes[set].size());
    add_moved_nodes(*cells_, {place.r - from.r, place.theta - from.theta}, set, 1.0F, nodes);
    keep(set, nodes);
  }
}

DiskLayers::DiskLayers(std::shared_ptr<const JoinedDisk> stations, const LensPlace& place)
    : cells_(stations, &stations->first) {
  set_edge(place);
  const CubicMix mix = mix_of(*stations, place);
  const auto weight = static_cast<float>(mix.second_weight);
  for (int set = 0; set < cells_->sets(); ++set) {
    std::vector<float> nodes(cells_->nodes[set].size());
    add_moved_nodes(stations->first, mix.offsets[0], set, 1.0F - weight, nodes);
    add_moved_nodes(stations->second, mix.offsets[1], set, weight, nodes);
    keep(set, nodes);
  }
}

void DiskLayers::set_edge(const LensPlace& place) {
  edge_.emplace(Backend::cpu,
                make_camera_station(cells_->cells.spacetime, place.r, place.theta, 0.0, ObserverMotion::rain),
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
