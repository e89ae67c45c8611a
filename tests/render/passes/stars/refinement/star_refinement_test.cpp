#include "render/passes/stars/refinement/star_refinement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/passes/stars/image_observer.h"
#include "render/passes/stars/refinement/candidate_course.h"
#include "tests/render/exact_sky.h"

namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the cameras of these tests

//! Simulates Newton's method for a star image near a fold of the lens, f(x) = s² / (2 curvature).
//! The star is `beyond` the fold by an angle [rad], so it has no image.
class FoldedSky {
 public:
  explicit FoldedSky(double beyond) : beyond_(beyond) {}

  //! Follows a candidate that starts at the distance x from the fold [rad]. Returns how many rays
  //! it takes, at most 24.
  int rays_from(double x) {
    CandidateCourse course;
    course.rays = RayKind::fine;
    const StarEye eye(eye_at_position(positions[0]));
    const ImageSearch search = {eye, {}, fine_pixel, {}, [](const StarCandidate&) { return true; }};
    int rays = 0;
    do {
      look_from(x);
      ++rays;
    } while (next_ray(candidate_, course, search));
    return rays;
  }

  [[nodiscard]] bool is_found() const { return candidate_.miss <= image_tolerance_px * fine_pixel; }

 private:
  static constexpr double curvature = 5.0;

  //! Simulates the ray at x, and moves x by a step of the method.
  void look_from(double& x) {
    const double s = curvature * x;
    const double missing = -beyond_ - 0.5 * curvature * x * x;
    candidate_.edge_distance = 0.05;
    candidate_.radius = 1e-9;
    candidate_.solid_angle = s;
    candidate_.stretch = 1.0 + s * s;
    candidate_.miss = std::abs(missing / s);
    candidate_.change = std::min(std::abs(missing) / (s * s), 1.0);
    x += missing / s;
  }

  double beyond_;
  StarCandidate candidate_;
};

TEST(StarBeyondAFold, IsNotSoughtForLong) {
  for (const double x : {1e-4, 3e-4, 1e-3, 2e-3}) {
    FoldedSky sky(1e-6);
    EXPECT_LE(sky.rays_from(x), 4) << x;
    EXPECT_FALSE(sky.is_found()) << x;
  }
}

TEST(StarBeforeAFold, IsFound) {
  for (const double beyond : {-1e-6, -1e-9, -1e-12}) {
    FoldedSky sky(beyond);
    sky.rays_from(2e-3);
    EXPECT_TRUE(sky.is_found()) << beyond;
  }
}

// If the star's disk reaches the fold, or may reach it, the search must continue.
TEST(StarOnAFold, IsSoughtOn) {
  FoldedSky sky(1e-9);
  EXPECT_GT(sky.rays_from(1e-3), 8);
}

//! Returns search candidates near images that rays have found. For some of them, the star was moved
//! away.
std::vector<StarCandidate> candidates_about(const EyeCamera& eye) {
  const CameraStation camera = make_camera_station(eye.spacetime, eye.r, eye.theta, 0.0, eye.motion, eye.velocity);
  std::vector<StarCandidate> candidates;
  constexpr int count = 700;
  candidates.reserve(count);
  for (int i = 0; i < count; ++i) {
    const double along = 0.3 + 2e-3 * i;
    const double up = 0.4 * std::sin(7.0 * i);
    const Vector3<double> there = unit_of({-std::cos(along), up, std::sin(along)});
    const Vector3<double> sky = exact_sky(camera, there);
    if (!(dot(sky, sky) < 2.0)) {
      continue;
    }
    StarCandidate candidate;
    candidate.star = i;
    candidate.on_sky = i % 5 == 0 ? unit_of(sky + Vector3<double>{0.01, 0.0, 0.02}) : sky;
    candidate.direction = unit_of(there + Vector3<double>{1e-4, -2e-4, 1e-4});
    candidate.radius = 1e-9;
    candidate.edge_distance = 0.1;
    candidates.push_back(candidate);
  }
  return candidates;
}

TEST(StarRefinement, OfACandidateHangsOnNoOther) {
  const StarEye eye(eye_at_position(positions[0]));
  const ImageSearch search = {eye, {}, fine_pixel, {}, [](const StarCandidate&) { return true; }};
  std::vector<StarCandidate> all = candidates_about(eye.camera);
  ASSERT_GT(all.size(), 300U);
  std::vector<StarCandidate> reversed(all.rbegin(), all.rend() - 100);
  refine_images(all, search);
  refine_images(reversed, search);
  for (std::size_t i = 0; i < reversed.size(); ++i) {
    const StarCandidate& here = all[all.size() - 1 - i];
    EXPECT_EQ(here.direction.x, reversed[i].direction.x) << here.star;
    EXPECT_EQ(here.direction.y, reversed[i].direction.y) << here.star;
    EXPECT_EQ(here.miss, reversed[i].miss) << here.star;
    EXPECT_EQ(here.solid_angle, reversed[i].solid_angle) << here.star;
  }
}

}  // namespace
}  // namespace ergodome
