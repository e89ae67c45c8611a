#include "render/lens/station_blend.h"

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <utility>

#include "kernels/shadow/critical_curve.h"
#include "render/lens/edge_table.h"

namespace ergodome {

namespace {

//! How far an ingoing principal null ray turns about the axis on its way from infinity to r [rad]: the integral of a / Δ.
double principal_turn(double spin, double r) {
  const double half = std::sqrt(std::max(0.0, (1.0 - spin) * (1.0 + spin)));  // (r_+ - r_-) / 2
  const double x = half / (r - 1.0);
  return spin / (r - 1.0) * (x > 1e-4 ? std::atanh(x) / x : 1.0 + x * x / 3.0);
}

//! The rotation that takes a station's sky to that of a camera at (r, θ).
void set_turn(const LensStation& station, double r, double theta, float (&turn)[3][3]) {
  const double before = principal_turn(station.spin, station.r);
  const double after = principal_turn(station.spin, r);
  const auto about_axis = [](double angle) {
    return glm::dmat3(std::cos(angle), std::sin(angle), 0.0, -std::sin(angle), std::cos(angle), 0.0, 0.0, 0.0, 1.0);
  };
  const double tilt = theta - station.theta;
  const glm::dmat3 tilted(std::cos(tilt), 0.0, -std::sin(tilt), 0.0, 1.0, 0.0, std::sin(tilt), 0.0, std::cos(tilt));
  const glm::dmat3 whole = about_axis(-after) * tilted * about_axis(before);
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
                           std::shared_ptr<const StationBuffers> second, double second_weight, double r, double theta)
    : first_(std::move(first)), second_(std::move(second)), second_weight_(static_cast<float>(second_weight)) {
  const LensStation& a = first_->station();
  const LensStation& b = second_->station();
  const CameraStation rain = make_camera_station(a.spin, r, theta, 0.0, ObserverMotion::rain);
  const ShadowChart chart = make_shadow_chart(rain);
  const std::vector<float> edge = solve_edge(rain, chart, static_cast<int>(a.edge.size()));
  edge_ = Buffer<float>(backend, edge);
  chart_.edge = edge_view(chart, edge);
  chart_.edge.polar_angle = edge_.data();
  chart_.range = a.range + second_weight_ * (b.range - a.range);
  set_turn(a, r, theta, turn_[0]);
  set_turn(b, r, theta, turn_[1]);
}

LensBlend StationBlend::view() const {
  const LensGrid first = first_->view();
  LensBlend lens{chart_, {first, second_ ? second_->view() : first}, {}, second_ ? second_weight_ : 0.0F};
  std::copy_n(&turn_[0][0][0], 18, &lens.turn[0][0][0]);
  return lens;
}

}  // namespace ergodome
