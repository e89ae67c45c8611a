#include "render/lens/stations/station_blend.h"

#include <algorithm>
#include <utility>

#include "render/lens/grid/edge_table.h"
#include "render/lens/stations/station_derivatives.h"

namespace ergodome {

namespace {

//! Computes frame_rotation() from a station to a position, in the form that kernels need.
void set_turn(const LensStation& station, const LensPosition& position, float (&turn)[3][3]) {
  const glm::dmat3 whole = frame_rotation(station.spacetime, {station.r, station.theta}, position);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      turn[i][j] = static_cast<float>(whole[j][i]);
    }
  }
}

std::size_t bytes_for(std::size_t edge, std::size_t tree, std::size_t leaves, std::size_t nodes, bool derivatives) {
  const std::size_t copies = derivatives ? 4 : 1;
  return sizeof(float) * (edge + copies * floats_a_node * nodes) + sizeof(int) * (tree + 4 * leaves);
}

//! Names of buffers.
constexpr const char* grid_buffer = "lens grid";
constexpr const char* moved_grid_buffer = "lens grid at a position between stations";

LensPosition position_of(const LensStation& station) { return {station.r, station.theta}; }

}  // namespace

StationBuffers::StationBuffers(Backend backend, LensStation station)
    : bytes_(bytes_for(station.edge.size(), station.tree.size(), station.leaf_count(), station.node_count(),
                       !station.nodes_along_r.empty())),
      station_(std::move(station)),
      edge_(backend, station_.edge, grid_buffer),
      tree_(backend, station_.tree, grid_buffer),
      leaves_(backend, station_.leaves, grid_buffer),
      nodes_(backend, station_.nodes, grid_buffer) {
  for (std::vector<float>* unused : {&station_.leaf_error_px, &station_.traced_nodes, &station_.leaf_displacements}) {
    std::vector<float>().swap(*unused);
  }
  if (!has_derivatives()) {
    std::vector<float>().swap(station_.nodes);
  }
  for (std::vector<int>* large : {&station_.tree, &station_.leaves}) {
    std::vector<int>().swap(*large);
  }
}

std::size_t StationBuffers::expected_bytes(const StationEntry& entry, bool derivatives) {
  // The tree has about two entries per leaf: a binary tree has one inner cell less than leaves.
  return bytes_for(edge_points, std::size_t{2} * entry.leaves, entry.leaves, entry.nodes, derivatives);
}

LensGrid StationBuffers::view() const {
  LensGrid grid = grid_view(station_);
  grid.chart.edge.polar_angle = edge_.data();
  grid.tree = tree_.data();
  grid.leaves = leaves_.data();
  grid.nodes = nodes_.data();
  return grid;
}

StationBlend::StationBlend(std::shared_ptr<const StationBuffers> station)
    : first_(std::move(station)), chart_(first_->view().chart) {}

StationBlend::StationBlend(Backend backend, std::shared_ptr<const StationBuffers> station, const LensPosition& position)
    : first_(std::move(station)) {
  const LensStation& a = first_->station();
  const LensPosition from = position_of(a);
  set_chart(backend, a.spacetime, position, a.range);
  nodes_[0] = Buffer<float>(
      backend,
      moved_nodes(a, {position.r - from.r, position.theta - from.theta}, frame_rotation(a.spacetime, from, position)),
      moved_grid_buffer);
}

StationBlend::StationBlend(Backend backend, std::shared_ptr<const StationBuffers> first,
                           std::shared_ptr<const StationBuffers> second, const LensPosition& position)
    : first_(std::move(first)), second_(std::move(second)) {
  const LensStation& a = first_->station();
  const LensStation& b = second_->station();
  const auto weight = static_cast<float>(position_weight(position_of(a), position_of(b), position));
  set_chart(backend, a.spacetime, position, a.range + weight * (b.range - a.range));
  set_turn(a, position, turn_[0]);
  set_turn(b, position, turn_[1]);
  second_weight_ = weight;
  if (first_->has_derivatives() && second_->has_derivatives()) {
    take_derivatives(backend, position);
  }
}

void StationBlend::set_chart(Backend backend, Spacetime spacetime, const LensPosition& position, float range) {
  const CameraStation rain = make_camera_station(spacetime, position.r, position.theta, 0.0, ObserverMotion::rain);
  edge_.emplace(backend, rain, edge_points);
  chart_ = {edge_->view(), range};
}

void StationBlend::take_derivatives(Backend backend, const LensPosition& position) {
  const CubicMix mix = cubic_mix(position_of(first_->station()), position_of(second_->station()), position);
  second_weight_ = static_cast<float>(mix.second_weight);
  for (int i = 0; i < 2; ++i) {
    nodes_[i] =
        Buffer<float>(backend, moved_nodes((i == 0 ? first_ : second_)->station(), mix.offsets[i], glm::dmat3(1.0)),
                      moved_grid_buffer);
  }
}

LensBlend StationBlend::view() const {
  LensGrid first = first_->view();
  first.nodes = nodes_[0].size() > 0 ? nodes_[0].data() : first.nodes;
  LensGrid second = second_ ? second_->view() : first;
  second.nodes = nodes_[1].size() > 0 ? nodes_[1].data() : second.nodes;
  LensBlend lens{chart_, {first, second}, {}, second_ ? second_weight_ : 0.0F};
  std::copy_n(&turn_[0][0][0], 18, &lens.turn[0][0][0]);
  return lens;
}

}  // namespace ergodome
