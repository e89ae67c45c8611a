#include "render/lens/lens_chooser.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kernels/projection/pixel_measure.h"
#include "render/lens/direct_lens.h"
#include "render/lens/grid/screen_error.h"
#include "render/lens/lens_source.h"
#include "render/lens/quadtree_source.h"
#include "render/lens/stations/lens_position.h"

namespace ergodome {

namespace {

//! Number of cached grids: for both eyes, at the current moment and the previous one.
constexpr std::size_t kept_grids = 4;
//! Factor by which errors that the bake did not measure may exceed the bake's or the frame's
//! budget, whichever is larger. A bake uses up most of its budget, so an eye beside the path, or a
//! frame beside damaged stations, may exceed it slightly.
constexpr double unmeasured_slack = 1.25;

double error_of(const GridOrder& order) { return order.settings.budget_px * order.settings.pixel; }

GridOrder order_for(const LensRequest& request) {
  const EyeCamera& eye = request.eye;
  GridOrder order;
  order.spacetime = eye.spacetime;
  order.position = {eye.r, eye.theta};
  order.settings.pixel = pixel_angle(request.projection);
  order.settings.budget_px = request.accuracy.budget_px;
  order.settings.observer = aberration_to_rain(eye.spacetime, eye.r, eye.theta, eye.motion, eye.velocity);
  order.settings.fine = error_of(order) < finest_float_budget;
  return order;
}

//! Returns whether a grid that was built for one observer can be used for an eye. Results are
//! correct for any velocity, but the cells of a grid are refined for its observer, so the
//! velocities must be similar.
bool moves_alike(ObserverMotion motion, const Vector3<double>& velocity, const EyeCamera& eye) {
  const Vector3<double> turn = velocity - eye.velocity;
  return motion == eye.motion && dot(turn, turn) < 1e-4;
}

}  // namespace

bool holds_budget(const TrajectoryProvenance& baked, double error) {
  return baked.budget_px * baked.pixel <= 1.01 * error;
}

bool may_stream(const TrajectoryProvenance& baked, LensChoice choice, const EyeCamera& eye, double error) {
  return (choice == LensChoice::streamed || (choice == LensChoice::automatic && holds_budget(baked, error))) &&
         (baked.derivatives || !is_beside(eye));
}

double allowed_unmeasured_px(const TrajectoryProvenance& baked, double budget_px, double pixel) {
  return unmeasured_slack * std::max(budget_px, baked.budget_px * baked.pixel / pixel);
}

const LensChooser::Grid* LensChooser::find(const GridOrder& order, const EyeCamera& eye, bool alike) {
  const double error = error_of(order);
  const auto found = std::find_if(grids_.begin(), grids_.end(), [&](const Grid& grid) {
    return grid.spacetime == order.spacetime && same_position({grid.r, grid.theta}, order.position) &&
           (alike ? grid.error == error : grid.error <= 1.01 * error && grid.error >= 0.5 * error) &&
           moves_alike(grid.motion, grid.velocity, eye);
  });
  if (found == grids_.end()) {
    return nullptr;
  }
  grids_.splice(grids_.begin(), grids_, found);
  return &grids_.front();
}

const LensChooser::Grid* LensChooser::find_near(const GridOrder& order, const EyeCamera& eye) {
  // Accepts a grid at a distance that a fast camera moves in one frame; a grid from farther away
  // would make the view jump.
  const auto found = std::find_if(grids_.begin(), grids_.end(), [&](const Grid& grid) {
    const double horizon = horizon_radius(order.spacetime);
    return grid.spacetime == order.spacetime &&
           std::abs(grid.r - order.position.r) < 0.1 * std::abs(order.position.r - 1.0) &&
           (grid.r > horizon) == (order.position.r > horizon) && std::abs(grid.theta - order.position.theta) < 0.1 &&
           grid.error <= 2.0 * error_of(order) && moves_alike(grid.motion, grid.velocity, eye);
  });
  return found != grids_.end() ? &*found : nullptr;
}

const LensChooser::Grid& LensChooser::keep(const GridOrder& order, const EyeCamera& eye, LensStation station,
                                           const GridStatistics& statistics) {
  grids_.push_front({order.spacetime, order.position.r, order.position.theta, error_of(order), eye.motion, eye.velocity,
                     statistics.flagged_px, std::make_shared<StationBuffers>(backend_, std::move(station))});
  ++built_;
  if (grids_.size() > kept_grids) {
    grids_.pop_back();
  }
  return grids_.front();
}

const LensChooser::Grid& LensChooser::grid_for(const LensRequest& request) {
  const EyeCamera& eye = request.eye;
  const GridOrder order = order_for(request);
  if (const Grid* kept = find(order, eye, request.moment.alike)) {
    return *kept;
  }
  if (backend_ == Backend::cpu && !is_beside(eye) && request.moment.patience_s < ShowMoment::forever_s) {
    if (!worker_) {
      worker_ = std::make_unique<GridWorker>();
    }
    const EyeCamera earlier = ordered_eye_.value_or(eye);
    ordered_eye_ = eye;
    if (auto made = worker_->build(order, request.moment.patience_s)) {
      const bool own = same_position(made->order.position, {eye.r, eye.theta});
      keep(made->order, own ? eye : earlier, std::move(made->station), made->statistics);
    }
    if (const Grid* kept = find(order, eye, request.moment.alike)) {
      return *kept;
    }
    if (const Grid* near = find_near(order, eye)) {
      return *near;
    }
  }
  GridStatistics statistics;
  LensStation station = build_lens_station(order.spacetime, order.position.r, order.position.theta, order.settings,
                                           &statistics, &tracer_);
  return keep(order, eye, std::move(station), statistics);
}

std::unique_ptr<LensSource> LensChooser::live(const LensRequest& request) {
  const double pixels = static_cast<double>(request.projection.width_px) * request.projection.height_px;
  const bool asked = request.choice == LensChoice::live || request.choice == LensChoice::streamed;
  if (!asked && !is_worth_a_grid(backend_, pixels)) {
    return nullptr;
  }
  const Grid& grid = grid_for(request);
  if (!asked && grid.traced_px >= 0.25 * pixels) {
    return nullptr;
  }
  EyeCamera eye = request.eye;
  const bool behind = !same_position({grid.r, grid.theta}, {eye.r, eye.theta});
  if (behind && eye.r > horizon_radius(eye.spacetime)) {
    // Adapts the azimuth, because the skies at two radii are similar in the azimuth of infalling
    // observers.
    eye.phi += ingoing_turn(eye.spacetime, eye.r) - ingoing_turn(eye.spacetime, grid.r);
  }
  eye.r = grid.r;
  eye.theta = grid.theta;
  return std::make_unique<GridLens>(backend_, "live", StationBlend(grid.station), eye, request.projection,
                                    request.accuracy.tolerance_px, behind);
}

std::unique_ptr<LensSource> LensChooser::streamed(const LensRequest& request) {
  if (!stream_ || !request.moment.time_s) {
    return nullptr;
  }
  const EyeCamera& eye = request.eye;
  const TrajectoryProvenance& baked = stream_->trajectory().provenance();
  const double pixel = pixel_angle(request.projection);
  const bool beside = is_beside(eye);
  if (!may_stream(baked, request.choice, eye, request.accuracy.budget_px * pixel)) {
    return nullptr;
  }
  const std::optional<StationPair> pair = stream_->at(*request.moment.time_s, request.moment.patience_s);
  // Errors that the bake did not measure are checked with rays on the CPU; a GPU does not use
  // stations for such frames.
  const bool unmeasured = beside || (pair && pair->skips);
  // A pair of stations with unreadable ones between them that was rejected once stays rejected, so
  // that frames do not alternate between lenses.
  if (!pair || (unmeasured && backend_ != Backend::cpu) || (pair->skips && refused_.lock() == pair->first)) {
    return nullptr;
  }
  // The accepted error, in pixels of the bake; at least the bake's own budget.
  const double allowed_px = std::max(request.accuracy.budget_px * pixel / baked.pixel, baked.budget_px);
  if (static_cast<double>(pair->gap_error_px) > 1.001 * allowed_px) {
    return nullptr;
  }
  const LensPosition position = {eye.r, eye.theta};
  StationBlend blend = pair->second                     ? StationBlend(backend_, pair->first, pair->second, position)
                       : pair->first->has_derivatives() ? StationBlend(backend_, pair->first, position)
                                                        : StationBlend(pair->first);
  if (unmeasured) {
    const LensView view = {eye.spacetime, position,
                           aberration_to_rain(eye.spacetime, eye.r, eye.theta, eye.motion, eye.velocity), pixel};
    const ChartSamples samples = pair->skips ? lattice_samples(64, 32) : lattice_samples(32, 16);
    const double error_px = measure_screen_error(blend.view(), view, samples).p99_px;
    if (error_px > allowed_unmeasured_px(baked, request.accuracy.budget_px, pixel)) {
      if (pair->skips) {
        refused_ = pair->first;
      }
      return nullptr;
    }
  }
  return std::make_unique<GridLens>(backend_, "streamed", std::move(blend), eye, request.projection,
                                    request.accuracy.tolerance_px);
}

std::unique_ptr<LensSource> LensChooser::published(const LensRequest& request) {
  const EyeCamera& eye = request.eye;
  const bool same = quadtree_eye_ && quadtree_eye_->spacetime == eye.spacetime &&
                    same_position({quadtree_eye_->r, quadtree_eye_->theta}, {eye.r, eye.theta}) &&
                    quadtree_eye_->motion == eye.motion && quadtree_eye_->velocity.x == eye.velocity.x &&
                    quadtree_eye_->velocity.y == eye.velocity.y && quadtree_eye_->velocity.z == eye.velocity.z;
  if (!same) {
    const CameraStation camera = make_camera_station(eye.spacetime, eye.r, eye.theta, 0.0, eye.motion, eye.velocity);
    const bool mirrored = quadtree_is_mirrored(eye.theta, eye.velocity);
    quadtree_ = std::make_shared<const QuadtreeLens>(camera, mirrored, QuadtreeSettings{});
    quadtree_eye_ = eye;
  }
  return std::make_unique<QuadtreeSource>(quadtree_, eye, request.projection, request.accuracy.tolerance_px);
}

std::unique_ptr<LensSource> LensChooser::choose(const LensRequest& request) {
  const bool about_rays = shows_rays(request.mode);
  std::unique_ptr<LensSource> lens;
  if (!about_rays && request.choice != LensChoice::direct && request.scheme == GridScheme::quadtree &&
      backend_ == Backend::cpu) {
    lens = published(request);
  } else if (!about_rays && request.choice != LensChoice::direct &&
             edge_miss_.of(request.eye) <= request.accuracy.budget_px * pixel_angle(request.projection)) {
    if (request.choice != LensChoice::live) {
      lens = streamed(request);
    }
    if (!lens) {
      lens = live(request);
    }
  }
  return lens ? std::move(lens)
              : std::make_unique<DirectLens>(backend_, request.eye, request.projection, request.accuracy.tolerance_px);
}

}  // namespace ergodome
