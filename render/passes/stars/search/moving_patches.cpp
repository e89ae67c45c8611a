#include "render/passes/stars/search/moving_patches.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kernels/core/angles.h"
#include "kernels/launch/launch.h"
#include "kernels/launch/parallel_for.h"
#include "kernels/spacetime/kerr/kerr.h"
#include "kernels/spacetime/shadow/critical_curve.h"
#include "render/lens/grid/edge_table.h"
#include "render/lens/stations/station_derivatives.h"
#include "render/passes/stars/search/sky_frustum.h"

namespace ergodome {

namespace {

//! Minimum height above the horizon [M] and minimum angle from the spin axis [rad] of cells.
constexpr double min_cell_height = 0.5;
constexpr double min_cell_angle = 0.1;
constexpr int moved_patches_a_chunk = 512;

double middle_of_cell(double coordinate, double extent) { return (std::floor(coordinate / extent) + 0.5) * extent; }

//! Returns the part of a patch that begins at (begin_u, begin_v) and has the given size, a power of
//! two along each axis.
BezierPatch part_of_patch(const BezierPatch& whole, double begin_u, double size_u, double begin_v, double size_v) {
  BezierPatch part = whole;
  const auto narrow = [&](int axis, double begin, double size) {
    for (; size < 0.75; size *= 2.0) {
      BezierPatch first;
      BezierPatch second;
      split(part, axis, first, second);
      const bool lower = begin + 0.5 * size < 0.5;
      part = lower ? first : second;
      begin = 2.0 * begin - (lower ? 0.0 : 1.0);
    }
  };
  narrow(0, begin_u, size_u);
  narrow(1, begin_v, size_v);
  return part;
}

double rotation_angle(const glm::dmat3& turn) {
  return std::acos(std::clamp(0.5 * (turn[0][0] + turn[1][1] + turn[2][2] - 1.0), -1.0, 1.0));
}

}  // namespace

std::optional<LensPosition> cell_middle(Spacetime spacetime, const LensPosition& position) {
  const double horizon = horizon_radius(spacetime);
  const double height = position.r - horizon;
  if (!(height > min_cell_height && position.theta > min_cell_angle && position.theta < pi - min_cell_angle)) {
    return std::nullopt;
  }
  return LensPosition{horizon + std::exp(middle_of_cell(std::log(height), position_cell_height)),
                      middle_of_cell(position.theta, position_cell_theta)};
}

LensPosition cell_reach(Spacetime spacetime, const LensPosition& middle) {
  return {std::expm1(0.5 * position_cell_height) * (middle.r - horizon_radius(spacetime)), 0.5 * position_cell_theta};
}

MovingPatches::MovingPatches(LensStation station, StarPatches patches, MotionRoom& room)
    : station_(std::move(station)),
      patches_(std::move(patches)),
      motions_(std::move(room.motions)),
      reach_(cell_reach(station_.spacetime, {station_.r, station_.theta})) {
  const LensPosition middle = {station_.r, station_.theta};
  for (const double side : {-1.0, 1.0}) {
    const LensPosition corner = {middle.r + side * reach_.r, middle.theta + reach_.theta};
    largest_turn_ = std::max(largest_turn_, rotation_angle(frame_rotation(station_.spacetime, middle, corner)));
  }
  const auto grid_of = [&](const std::vector<float>& nodes) {
    LensGrid grid = grid_view(station_);
    grid.nodes = nodes.data();
    return grid;
  };
  const LensGrid along_r = grid_of(station_.nodes_along_r);
  const LensGrid along_theta = grid_of(station_.nodes_along_theta);
  const LensGrid along_r_r = grid_of(station_.nodes_along_r_r);
  const LensGrid along_r_theta = grid_of(station_.nodes_along_r_theta);
  const std::vector<LeafBox> boxes = leaf_boxes(station_);
  std::vector<StarPatch> wider = std::move(patches_).given_up();
  motions_.resize(wider.size());
  parallel_for(static_cast<int>(wider.size()), moved_patches_a_chunk, [&](int begin, int end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      StarPatch& patch = wider[i];
      const LeafBox& box = boxes[static_cast<std::size_t>(patch.leaf)];
      const auto motion = [&](const LensGrid& grid) {
        const BezierPatch whole =
            bezier_patch(grid, patch.leaf, static_cast<float>(box.width_turns), static_cast<float>(box.height));
        const auto share = [](float from, double begin_at, double size) {
          return (static_cast<double>(from) - begin_at) / size;
        };
        return in_frame(part_of_patch(whole, share(patch.gamma_turns, box.gamma_turns, box.width_turns),
                                      share(patch.width_turns, 0.0, box.width_turns), share(patch.s, box.s, box.height),
                                      share(patch.height, 0.0, box.height)),
                        patch.frame);
      };
      motions_[i] = {motion(along_r), motion(along_theta), motion(along_r_r), motion(along_r_theta)};
      widen(patch, motions_[i]);
    }
  });
  patches_ = StarPatches(std::move(patches_), std::move(wider));
  // Only the nodes of rays are needed from here on.
  station_.nodes = station_.traced_nodes;
}

MotionRoom MovingPatches::given_up() && {
  MotionRoom room;
  room.patches.patches = std::move(patches_).given_up();
  room.motions = std::move(motions_);
  return room;
}

//! Widens the part of the sky in which the stars of a patch are sought, so that it contains the
//! patch at all positions in the cell.
void MovingPatches::widen(StarPatch& patch, const PatchMotion& motion) const {
  double farthest = 0.0;
  double cosine = 1.0;
  for (int i = 0; i < 16; ++i) {
    const auto length = [](const Vector3<double>& v) { return std::sqrt(dot(v, v)); };
    const Vector3<double> point = control_point(patch.sky, i);
    const double size = std::max(length(point), 1e-3);
    const double moves =
        reach_.r * (length(control_point(motion.along_r, i)) + reach_.r * length(control_point(motion.along_r_r, i)) +
                    reach_.theta * length(control_point(motion.along_r_theta, i))) +
        reach_.theta * length(control_point(motion.along_theta, i));
    farthest = std::max(farthest, moves / size);
    cosine = std::min(cosine, (point.z - moves) / size);
  }
  // Distances in the plane z = 1 exceed the angles behind them by a factor of 1 / cosine².
  const double beside = (largest_turn_ + farthest) / std::max(cosine * std::abs(cosine), 1e-2);
  patch.part = sky_part(frustum_of(patch.sky, patch.frame, static_cast<double>(patch.error) + beside));
}

LensStation MovingPatches::station_at(const LensPosition& position) const {
  LensStation there;
  there.spacetime = station_.spacetime;
  there.r = position.r;
  there.theta = position.theta;
  const CameraStation rain =
      make_camera_station(station_.spacetime, position.r, position.theta, 0.0, ObserverMotion::rain);
  const ShadowChart chart = make_shadow_chart(rain);
  there.edge = solve_edge(rain, chart, edge_points);
  const EdgeCurve edge = edge_view(chart, there.edge);
  there.centre = edge.centre;
  there.first = edge.first;
  there.second = edge.second;
  there.range = station_.range;
  there.columns = station_.columns;
  there.rows = station_.rows;
  return there;
}

StarPatches MovingPatches::patches_at(const LensStation& there, PatchRoom& room) const {
  const LensPosition offset = {there.r - station_.r, there.theta - station_.theta};
  const glm::dmat3 turn = frame_rotation(station_.spacetime, {station_.r, station_.theta}, {there.r, there.theta});
  const std::vector<StarPatch>& from = patches_.patches();
  std::vector<StarPatch> moved = std::move(room.patches);
  moved.resize(from.size());
  PatchMotionBatch batch{static_cast<int>(from.size()),    from.data(), motions_.data(), static_cast<float>(offset.r),
                         static_cast<float>(offset.theta), {},          moved.data()};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      batch.turn[row][column] = turn[column][row];
    }
  }
  launch(batch);
  return {patches_, there, moved_nodes(station_, offset, turn), std::move(moved)};
}

}  // namespace ergodome
