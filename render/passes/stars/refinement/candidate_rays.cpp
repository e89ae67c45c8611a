#include "render/passes/stars/refinement/candidate_rays.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "kernels/launch/launch.h"
#include "kernels/launch/work_counter.h"
#include "render/passes/stars/drawing/edge_rounding.h"

namespace ergodome {

namespace {

//! Errors on the sky of double-precision rays (compare float_tolerance): usual, and next to
//! caustics. An image moves by this error divided by the smaller singular value of the lens map.
constexpr double fine_tolerance = 1e-9;
constexpr double finest_tolerance = 1e-11;
//! Maximum position error of an image where the magnification changes quickly [rad].
constexpr double fine_miss = 1e-7;
//! Maximum position error of an image next to a caustic, where the magnification changes within
//! tiny distances from a ring [rad].
constexpr double ring_tolerance = 1e-10;

//! Returns the maximum number of steps of a ray: 120 at r > 2 M around holes with spins up to
//! 0.999, otherwise 400, for light that orbits the hole. With 120 steps, none of 118,216 images is
//! lost (nor would be with 80); at r = 1.3 M, five of 370,553 would be. A high limit is slow,
//! because all SIMD lanes wait for the longest ray.
int star_step_limit(const EyeCamera& eye) {
  constexpr double fastest_usual = 0.999;
  constexpr double min_usual_r = 2.0;
  return std::abs(eye.spacetime.spin) <= fastest_usual && eye.r > min_usual_r ? 120 : 400;
}

double tolerance_of(RayKind kind) {
  switch (kind) {
    case RayKind::quick:
      return float_tolerance;
    case RayKind::fine:
      return fine_tolerance;
    case RayKind::finest:
      break;
  }
  return finest_tolerance;
}

long nanoseconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now() - begin).count();
}

OmniCameraOf<float> omni_cameras(const OmniEye& eye, float /*precision*/) { return eye.cameras->on_host(eye.side); }
OmniCameraOf<double> omni_cameras(const OmniEye& eye, double /*precision*/) { return eye.cameras->exact(eye.side); }

}  // namespace

double last_miss(RayKind kind, double pixel) {
  const double shown = image_tolerance_px * pixel;
  switch (kind) {
    case RayKind::quick:
      return shown;
    case RayKind::fine:
      return std::min(shown, fine_miss);
    case RayKind::finest:
      break;
  }
  return std::min(shown, ring_tolerance);
}

template <class S>
CandidateRays::Setup<S> CandidateRays::setup_of(const ImageSearch& search) {
  const StarChartOf<S> chart = {search.chart.chart, converted_aberration<S>(search.chart.aberration)};
  if (search.eye.omni) {
    return {omni_cameras(*search.eye.omni, S{}), chart};
  }
  const EyeCamera& c = search.eye.camera;
  return {converted_station<S>(make_camera_station(c.spacetime, c.r, c.theta, 0.0, c.motion, c.velocity)), chart};
}

CandidateRays::CandidateRays(const ImageSearch& search)
    : pixel_(search.pixel),
      step_limit_(star_step_limit(search.eye.camera)),
      quick_(setup_of<float>(search)),
      exact_(setup_of<double>(search)) {}

std::size_t CandidateRays::lanes(RayKind kind) {
  const InstructionSet set = active_instruction_set();
  return static_cast<std::size_t>(kind == RayKind::quick ? cpu_kernel<StarImageBatch<float>>(set).lanes
                                                         : cpu_kernel<StarImageBatch<double>>(set).lanes);
}

template <class S>
void CandidateRays::follow_in(const Setup<S>& setup, RayKind kind, std::span<StarCandidate* const> candidates) const {
  constexpr std::size_t max_lanes = 16;
  constexpr std::size_t channels = 13;
  std::array<std::array<S, max_lanes>, channels> values{};
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const StarCandidate& c = *candidates[i];
    const std::array parts = {c.on_sky.x,    c.on_sky.y,    c.on_sky.z,      c.direction.x,
                              c.direction.y, c.direction.z, c.edge_distance, c.radius};
    for (std::size_t part = 0; part < parts.size(); ++part) {
      values[part][i] = static_cast<S>(parts[part]);
    }
  }
  const auto channel = [&](std::size_t part) { return values[part].data(); };
  std::visit(
      [&](const auto& camera) {
        run_on_this_thread(StarImageBatch<S, std::decay_t<decltype(camera)>>{camera,
                                                                             setup.chart,
                                                                             {tolerance_of(kind), step_limit_, true},
                                                                             static_cast<S>(last_miss(kind, pixel_)),
                                                                             1,
                                                                             static_cast<int>(candidates.size()),
                                                                             {channel(0), channel(1), channel(2)},
                                                                             channel(6),
                                                                             channel(7),
                                                                             {channel(3), channel(4), channel(5)},
                                                                             channel(8),
                                                                             channel(9),
                                                                             channel(10),
                                                                             channel(11),
                                                                             channel(12)});
      },
      setup.camera);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    StarCandidate& c = *candidates[i];
    const auto at = [&](std::size_t part) { return static_cast<double>(values[part][i]); };
    c.direction = {at(3), at(4), at(5)};
    c.solid_angle = at(8);
    c.stretch = at(9);
    c.frequency_ratio = at(10);
    c.miss = at(11);
    c.change = at(12);
  }
}

void CandidateRays::follow(RayKind kind, std::span<StarCandidate* const> candidates) {
  const auto begin = std::chrono::steady_clock::now();
  if (kind == RayKind::quick) {
    follow_in(quick_, kind, candidates);
  } else {
    follow_in(exact_, kind, candidates);
  }
  Tally& tally = tallies_[kind == RayKind::quick ? 0 : 1];
  tally.rays += static_cast<long>(candidates.size());
  tally.time_ns += nanoseconds_since(begin);
}

CandidateRays::~CandidateRays() {
  static WorkCounter in_float("find_star_images");
  static WorkCounter in_double("find_star_images, double");
  const double time_ns = static_cast<double>(nanoseconds_since(begin_));
  const double of_threads_ns = static_cast<double>(std::max(tallies_[0].time_ns + tallies_[1].time_ns, 1L));
  const auto count = [&](WorkCounter& counter, const Tally& tally) {
    counter.count(tally.rays);
    counter.add_time(std::lround(time_ns * static_cast<double>(tally.time_ns) / of_threads_ns));
  };
  count(in_float, tallies_[0]);
  count(in_double, tallies_[1]);
}

}  // namespace ergodome
