#include "render/lens/lens_chooser.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "render/lens/direct_lens.h"
#include "render/lens/grid_builder.h"
#include "render/lens/quadtree_source.h"
#include "render/lens/screen_error.h"

namespace ergodome {

namespace {

//! Both eyes, and both of the moment before.
constexpr std::size_t kept_grids = 4;
//! Below this many pixels a grid is not worth its while; compare dome_frame/direct and dome_frame/live_grid in tests/bench.
constexpr double least_pixels = 150'000.0;
//! A bake uses up most of its budget; an eye beside the path may take a little more.
constexpr double beside_slack = 1.25;
//! Float traces grids well down to this budget [rad].
constexpr double finest_float_budget = 2e-5;

}  // namespace

const LensChooser::Grid& LensChooser::grid_for(const EyeCamera& eye, const Projection& projection, double budget_px) {
  const double pixel = pixel_angle(projection);
  const double error = budget_px * pixel;
  const auto serves = [&](const Grid& grid) {
    // A grid serves any motion, but was refined where its own observer looks closely: the motion may differ, not much.
    const Vector3<double> turn = grid.velocity - eye.velocity;
    return grid.spin == eye.spin && grid.r == eye.r && grid.theta == eye.theta && grid.error <= 1.01 * error &&
           grid.error >= 0.5 * error && grid.motion == eye.motion && dot(turn, turn) < 1e-4;
  };
  const auto found = std::find_if(grids_.begin(), grids_.end(), serves);
  if (found != grids_.end()) {
    grids_.splice(grids_.begin(), grids_, found);
    return grids_.front();
  }
  GridSettings settings;
  settings.pixel = pixel;
  settings.budget_px = budget_px;
  settings.observer = aberration_to_rain(eye.spin, eye.r, eye.theta, eye.motion, eye.velocity);
  settings.fine = error < finest_float_budget;
  GridStatistics statistics;
  LensStation station = build_lens_station(eye.spin, eye.r, eye.theta, settings, &statistics);
  grids_.push_front({eye.spin, eye.r, eye.theta, error, eye.motion, eye.velocity, statistics.flagged_px,
                     std::make_shared<StationBuffers>(backend_, std::move(station))});
  ++built_;
  if (grids_.size() > kept_grids) {
    grids_.pop_back();
  }
  return grids_.front();
}

std::unique_ptr<LensSource> LensChooser::live(const LensRequest& request) {
  const double pixels = static_cast<double>(request.projection.width_px) * request.projection.height_px;
  // On a GPU rays are cheap, and grids come from the CPU.
  const bool worth_a_grid = backend_ == Backend::cpu && pixels >= least_pixels;
  const bool asked = request.choice == LensChoice::live || request.choice == LensChoice::streamed;
  if (!asked && !worth_a_grid) {
    return nullptr;
  }
  const Grid& grid = grid_for(request.eye, request.projection, request.accuracy.budget_px);
  if (!asked && grid.traced_px >= 0.25 * pixels) {
    return nullptr;
  }
  return std::make_unique<GridLens>(backend_, "live", StationBlend(grid.station), request.eye, request.projection,
                                    request.accuracy.tolerance_px);
}

std::unique_ptr<LensSource> LensChooser::streamed(const LensRequest& request) {
  if (!stream_ || !request.moment.time_s) {
    return nullptr;
  }
  const EyeCamera& eye = request.eye;
  const TrajectoryProvenance& baked = stream_->trajectory().provenance();
  const double pixel = pixel_angle(request.projection);
  const bool fine_enough = baked.budget_px * baked.pixel <= 1.01 * request.accuracy.budget_px * pixel;
  const bool beside = eye.r != eye.head_r || eye.theta != eye.head_theta;
  // The check of an eye beside the path runs on the host.
  if ((request.choice == LensChoice::automatic && !fine_enough) ||
      (beside && (!baked.derivatives || backend_ != Backend::cpu))) {
    return nullptr;
  }
  const std::optional<StationPair> pair = stream_->at(*request.moment.time_s, request.moment.patience_s);
  if (!pair) {
    return nullptr;
  }
  const LensPlace place = {eye.r, eye.theta};
  StationBlend blend = pair->second                     ? StationBlend(backend_, pair->first, pair->second, place)
                       : pair->first->has_derivatives() ? StationBlend(backend_, pair->first, place)
                                                        : StationBlend(pair->first);
  if (beside) {
    const LensView view = {eye.spin, place, aberration_to_rain(eye.spin, eye.r, eye.theta, eye.motion, eye.velocity),
                           pixel};
    const double error_px = measure_screen_error(blend.view(), view, lattice_samples(32, 16)).p99_px;
    if (error_px > beside_slack * std::max(request.accuracy.budget_px, baked.budget_px * baked.pixel / pixel)) {
      return nullptr;
    }
  }
  return std::make_unique<GridLens>(backend_, "streamed", std::move(blend), eye, request.projection,
                                    request.accuracy.tolerance_px);
}

std::unique_ptr<LensSource> LensChooser::published(const LensRequest& request) {
  const EyeCamera& eye = request.eye;
  const bool same = quadtree_eye_ && quadtree_eye_->spin == eye.spin && quadtree_eye_->r == eye.r &&
                    quadtree_eye_->theta == eye.theta && quadtree_eye_->motion == eye.motion &&
                    quadtree_eye_->velocity.x == eye.velocity.x && quadtree_eye_->velocity.y == eye.velocity.y &&
                    quadtree_eye_->velocity.z == eye.velocity.z;
  if (!same) {
    const CameraStation camera = make_camera_station(eye.spin, eye.r, eye.theta, 0.0, eye.motion, eye.velocity);
    const bool mirrored = std::abs(eye.theta - 0.5 * 3.14159265358979323846) < 1e-9 && eye.velocity.y == 0.0;
    quadtree_ = std::make_shared<const QuadtreeLens>(camera, mirrored, QuadtreeSettings{});
    quadtree_eye_ = eye;
  }
  return std::make_unique<QuadtreeSource>(quadtree_, eye, request.projection, request.accuracy.tolerance_px);
}

std::unique_ptr<LensSource> LensChooser::choose(const LensRequest& request) {
  const bool about_rays = request.mode == ViewMode::steps || request.mode == ViewMode::error_estimate ||
                          request.mode == ViewMode::image_order;
  std::unique_ptr<LensSource> lens;
  if (!about_rays && request.choice != LensChoice::direct && request.scheme == GridScheme::quadtree &&
      backend_ == Backend::cpu) {
    lens = published(request);
  } else if (!about_rays && request.choice != LensChoice::direct) {
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
