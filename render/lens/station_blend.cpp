#include "render/lens/station_blend.h"

#include <algorithm>
#include <utility>

#include "kernels/shadow/critical_curve.h"
#include "render/lens/edge_table.h"
#include "render/lens/place_turn.h"

namespace ergodome {

namespace {

//! place_turn from a station, as kernels have it.
void set_turn(const LensStation& station, const LensPlace& place, float (&turn)[3][3]) {
  const glm::dmat3 whole = place_turn(station.spin, {station.r, station.theta}, place);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      turn[i][j] = static_cast<float>(whole[j][i]);
    }
  }
}

}  // namespace

StationBuffers::StationBuffers(Backend backend, LensStation station)
    : station_(std::move(station)),
      edge_(backend, station_.edge),
      tree_(backend, station_.tree),
      leaves_(backend, station_.leaves),
      nodes_(backend, station_.nodes) {
  for (std::vector<float>* large : {&station_.nodes, &station_.leaf_error_px}) {
    std::vector<float>().swap(*large);
  }
  for (std::vector<int>* large : {&station_.tree, &station_.leaves}) {
    std::vector<int>().swap(*large);
  }
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

StationBlend::StationBlend(Backend backend, std::shared_ptr<const StationBuffers> first,
                           std::shared_ptr<const StationBuffers> second, const LensPlace& place)
    : first_(std::move(first)), second_(std::move(second)) {
  const LensStation& a = first_->station();
  const LensStation& b = second_->station();
  second_weight_ = static_cast<float>(place_weight({a.r, a.theta}, {b.r, b.theta}, place));
  const CameraStation rain = make_camera_station(a.spin, place.r, place.theta, 0.0, ObserverMotion::rain);
  const ShadowChart chart = make_shadow_chart(rain);
  const std::vector<float> edge = solve_edge(rain, chart, static_cast<int>(a.edge.size()));
  edge_ = Buffer<float>(backend, edge);
  chart_.edge = edge_view(chart, edge);
  chart_.edge.polar_angle = edge_.data();
  chart_.range = a.range + second_weight_ * (b.range - a.range);
  set_turn(a, place, turn_[0]);
  set_turn(b, place, turn_[1]);
}

LensBlend StationBlend::view() const {
  const LensGrid first = first_->view();
  LensBlend lens{chart_, {first, second_ ? second_->view() : first}, {}, second_ ? second_weight_ : 0.0F};
  std::copy_n(&turn_[0][0][0], 18, &lens.turn[0][0][0]);
  return lens;
}

}  // namespace ergodome
