#include "render/accuracy/scene.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "content/camera/camera_path.h"
#include "content/show/animated_show.h"
#include "kernels/projection/pixel_measure.h"
#include "render/eyes/view_projection.h"

namespace ergodome {

namespace {

bool same_pose(const CameraPose& a, const CameraPose& b) {
  return a.r == b.r && a.theta == b.theta && a.phi == b.phi &&
         std::abs(glm::dot(a.orientation, b.orientation)) > 1.0 - 1e-15;
}

bool stands_still(const Show& show) { return !camera_moves(show) && show.timeline.animations.empty(); }

AccuracyMoment moment_at(const Show& show, double time_s, int size_px) {
  AccuracyMoment moment;
  moment.show = show_at(show, time_s);
  moment.time_s = time_s;
  moment.projection = make_projection(moment.show.view, size_px, 0.0);
  moment.pixel = pixel_angle(moment.projection);
  const CameraPose pose = camera_pose(show, time_s);
  const double next_s = time_s + 1.0 / show.frame_rate_hz;
  const Show next_show = show_at(show, next_s);
  CameraPose next = camera_pose(show, next_s);
  if (same_pose(pose, next) && spacetime_of(next_show) == spacetime_of(moment.show)) {
    next.orientation = pose.orientation * glm::angleAxis(-0.5 * moment.pixel, glm::dvec3(0.0, 1.0, 0.0));
  }
  moment.pose = pose;
  moment.next_pose = next;
  moment.eye = eye_camera(moment.show, pose, 0.0);
  moment.next = eye_camera(next_show, next, 0.0);
  return moment;
}

}  // namespace

std::vector<AccuracyMoment> accuracy_moments(const Show& show, const AccuracySettings& settings) {
  const int size_px = settings.size_px > 0 ? settings.size_px : std::min(show.view.size_px, settings.max_px);
  const int count = stands_still(show) ? 1 : std::max(settings.moments, 1);
  std::vector<AccuracyMoment> moments;
  moments.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    moments.push_back(moment_at(show, show.duration_s * (i + 0.5) / count, size_px));
  }
  return moments;
}

PixelLattice pixel_lattice(const Projection& projection, int columns, std::uint64_t seed) {
  PixelLattice lattice;
  lattice.columns = std::clamp(columns, 1, projection.width_px);
  const double cell = static_cast<double>(projection.width_px) / lattice.columns;
  lattice.rows = std::clamp(static_cast<int>(std::lround(projection.height_px / cell)), 1, projection.height_px);
  std::mt19937_64 random(seed);
  // Uses its own conversion of random numbers: the distributions of the C++ standard differ between
  // libraries, but a seed must select the same pixels everywhere.
  const auto within = [&](int cell_number, int cells, int pixels) {
    const auto begin = static_cast<std::int64_t>(cell_number) * pixels / cells;
    const auto end = static_cast<std::int64_t>(cell_number + 1) * pixels / cells;
    return begin + static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(end - begin));
  };
  lattice.pixels.reserve(static_cast<std::size_t>(lattice.columns) * static_cast<std::size_t>(lattice.rows));
  for (int row = 0; row < lattice.rows; ++row) {
    for (int column = 0; column < lattice.columns; ++column) {
      const std::int64_t y = within(row, lattice.rows, projection.height_px);
      lattice.pixels.push_back(y * projection.width_px + within(column, lattice.columns, projection.width_px));
    }
  }
  return lattice;
}

}  // namespace ergodome
