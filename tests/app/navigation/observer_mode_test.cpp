#include "app/navigation/observer_mode.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "kernels/core/angles.h"

namespace ergodome {
namespace {

double speed(const Vector3<double>& v) { return std::sqrt(dot(v, v)); }

double min_guarded_r(double spin) { return horizon_radius(Spacetime{spin}) + 0.02; }

TEST(NearestVelocity, IsSlowerThanLightEverywhereOutsideTheGuard) {
  for (const double spin : {0.0, 0.5, 0.999, 1.0, -1.0, -0.9}) {
    for (const double theta : {0.0, 1e-9, 0.7, pi / 2, 3.0, pi}) {
      for (double r = min_guarded_r(spin); r < 2e6; r *= 1.05) {
        for (const ObserverMotion motion :
             {ObserverMotion::fixed, ObserverMotion::geodesic, ObserverMotion::retrograde}) {
          const double v = speed(nearest_velocity(motion, Spacetime{spin}, r, theta).velocity);
          ASSERT_TRUE(v <= fastest_stand_in) << spin << ' ' << theta << ' ' << r;
        }
      }
    }
  }
}

//! Moves inwards along a path in small steps, and returns the largest change of the observer's
//! velocity from one step to the next.
double largest_step(ObserverMotion motion, double spin, double theta) {
  double largest = 0.0;
  Vector3<double> last = nearest_velocity(motion, Spacetime{spin}, 8.0, theta).velocity;
  for (double r = 8.0; r > min_guarded_r(spin); r -= 1e-4) {
    const Vector3<double> now = nearest_velocity(motion, Spacetime{spin}, r, theta).velocity;
    largest = std::max(largest, speed(now - last));
    last = now;
  }
  return largest;
}

TEST(NearestVelocity, IsContinuousAcrossTheStaticLimitAndThePhotonOrbits) {
  for (const double spin : {0.0, 0.9, 1.0, -0.9}) {
    for (const ObserverMotion motion : {ObserverMotion::fixed, ObserverMotion::geodesic, ObserverMotion::retrograde}) {
      EXPECT_LT(largest_step(motion, spin, pi / 2), 5e-3) << spin;
      EXPECT_LT(largest_step(motion, spin, 0.6), 5e-3) << spin;
    }
  }
}

TEST(NearestVelocity, IsTheObserversOwnWhereThereIsOne) {
  const NearestVelocity fixed = nearest_velocity(ObserverMotion::fixed, Spacetime{0.9}, 3.0, 1.0);
  EXPECT_FALSE(fixed.nearest);
  EXPECT_EQ(fixed.velocity.z, observer_velocity(ObserverMotion::fixed, Spacetime{0.9}, 3.0, 1.0, {}).z);
}

// In the ergosphere, a substitute observer replaces the static one: it moves against the hole's
// rotation at its speed limit v_φ, so that dφ/dt = ω + v_φ Σ √Δ / (A sinθ).
TEST(NearestVelocity, InTheErgosphereTurnsMoreSlowlyThanTheSpaceAboutIt) {
  const double r = 1.7;
  const NearestVelocity view = nearest_velocity(ObserverMotion::fixed, Spacetime{0.9}, r, pi / 2);
  EXPECT_TRUE(view.nearest);
  EXPECT_DOUBLE_EQ(view.velocity.z, -fastest_stand_in);
  const KerrFunctions f = kerr_functions(Spacetime{0.9}, r, pi / 2);
  const double turning = f.frame_dragging + view.velocity.z * f.sigma * std::sqrt(f.delta) / f.area;
  EXPECT_GT(turning, 0.0);
  EXPECT_LT(turning, 0.7 * f.frame_dragging);
}

TEST(ObserverView, SaysWhatStandsInForWhat) {
  const CameraSettings shown;
  const auto sentence = [&](double r, const char* language) {
    return observer_view(ObserverMode::fixed, shown, std::nullopt, Spacetime{0.9}, r, pi / 2, language).sentence;
  };
  EXPECT_EQ(sentence(1000.0, "en"), "static observer, 0.00 c");
  EXPECT_EQ(sentence(1.7, "en"),
            "static observer, 0.99 c (nothing can stand still here: slowest possible motion instead)");
  EXPECT_EQ(sentence(10.0, "de").substr(0, 9), "ruhender ");
}

TEST(ObserverView, NaturalIsTheShowsUnlessTheCameraMovesByItself) {
  CameraSettings shown;
  shown.motion = ObserverMotion::rain;
  EXPECT_EQ(observer_view(ObserverMode::natural, shown, std::nullopt, Spacetime{0.9}, 5.0, 1.0).motion,
            ObserverMotion::rain);
  const ObserverView own = observer_of(ObserverMotion::velocity, {0.1, 0.2, 0.3}, Spacetime{0.9}, 5.0, 1.0);
  EXPECT_EQ(observer_view(ObserverMode::natural, shown, own, Spacetime{0.9}, 5.0, 1.0).velocity.y, 0.2);
  EXPECT_EQ(observer_view(ObserverMode::zamo, shown, own, Spacetime{0.9}, 5.0, 1.0).motion, ObserverMotion::zamo);
}

TEST(ObserverMode, ComesRoundThroughAllAndEachHasAName) {
  std::set<std::string> names;
  ObserverMode mode = ObserverMode::natural;
  CameraSettings shown;
  shown.motion = ObserverMotion::velocity;
  for (int i = 0; i < 6; ++i) {
    names.insert(observer_view(mode, shown, std::nullopt, Spacetime{0.5}, 10.0, 1.0).name);
    mode = next_observer(mode);
  }
  EXPECT_EQ(mode, ObserverMode::natural);
  EXPECT_EQ(names.size(), 6U);
}

TEST(ObserverFade, SlidesFromOneObserverToTheNextInASecond) {
  const CameraPose pose = {5.0, 1.3, 0.2, {1.0, 0.0, 0.0, 0.0}};
  ObserverFade fade;
  const auto at = [&](ObserverMotion motion) { return observer_of(motion, {}, Spacetime{0.9}, pose.r, pose.theta); };
  EXPECT_EQ(fade.advance(0.02, at(ObserverMotion::zamo), Spacetime{0.9}, pose).motion, ObserverMotion::zamo);
  Vector3<double> last{};
  for (int i = 0; i < 49; ++i) {
    const ObserverView now = fade.advance(0.02, at(ObserverMotion::rain), Spacetime{0.9}, pose);
    ASSERT_EQ(now.motion, ObserverMotion::velocity);
    ASSERT_LT(speed(now.velocity - last), 0.03);
    last = now.velocity;
  }
  fade.advance(0.1, at(ObserverMotion::rain), Spacetime{0.9}, pose);
  EXPECT_EQ(fade.advance(0.02, at(ObserverMotion::rain), Spacetime{0.9}, pose).motion, ObserverMotion::rain);
}

TEST(ObserverFade, GoesOverTheAxisWithoutALeap) {
  ObserverFade fade;
  const auto pose_at = [](double angle) {
    return CameraPose{5.0, std::abs(angle), angle < 0.0 ? 0.0 : pi, {1.0, 0.0, 0.0, 0.0}};
  };
  const ObserverView orbit = observer_of(ObserverMotion::velocity, {0.0, 0.4, 0.1}, Spacetime{0.9}, 5.0, 0.01);
  fade.advance(0.02, orbit, Spacetime{0.9}, pose_at(-0.01));
  glm::dvec3 last{0.0};
  for (int i = 0; i < 20; ++i) {
    const CameraPose pose = pose_at(-0.01 + 0.001 * (i + 0.5));
    const Vector3<double> v =
        fade.advance(0.02, observer_of(ObserverMotion::zamo, {}, Spacetime{0.9}, 5.0, pose.theta), Spacetime{0.9}, pose)
            .velocity;
    const glm::dvec3 now = spherical_frame(pose.theta, pose.phi) * glm::dvec3(v.x, v.y, v.z);
    if (i > 0) {
      EXPECT_LT(glm::distance(now, last), 0.03);
    }
    last = now;
  }
}

}  // namespace
}  // namespace ergodome
