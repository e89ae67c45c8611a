#include "kernels/objects/lamp_light.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kernels/core/angles.h"
#include "tests/kernels/lit_points.h"
#include "tests/kernels/mesh_scene.h"
#include "tests/kernels/reference_tables.h"

// Tests of the light of a lamp on surfaces: shadows and brightness.
namespace ergodome::test {
namespace {

//! Returns the illuminance of a surface at a point. The surface has the given normal and is lit by
//! a lamp; meshes may cast shadows on it.
double illuminance_of(double spin, const LitPoint& at, const Vector3<double>& normal, const MeshScene& scene,
                      LampFalloff falloff = LampFalloff::published) {
  LampCorrections corrections = {};
  const LitSurfacePoint position = {at.point, normal, {0.0, 0.0, 0.0}, at.point + 1e-6 * normal};
  return illuminance(
      lamp_light(Spacetime{spin}, {at.lamp, 100.0, falloff}, position, scene, {1e-10, 4000}, corrections), normal);
}

TEST(LampLight, WithoutSpinAndShadowsIsTheClosedFormsOfBothWaysRound) {
  const Placed elsewhere(make_sphere({}), {0.0, 0.0, 90.0}, 1.0);
  for (const LitPoint& at : lit_points()) {
    const Vector3<double> normal = (1.0 / length(at.point)) * at.point;
    const double both =
        illuminance(at.lamp, at.point, normal, 1, 100.0) + illuminance(at.lamp, at.point, normal, 2, 100.0);
    EXPECT_NEAR(illuminance_of(0.0, at, normal, {&elsewhere.mesh, 1, 88.0, 92.0}), both, 5e-4 * both + 1e-12);
  }
}

TEST(LampLight, IsTakenAwayByWhatStandsOnItsRayAndByNothingElse) {
  const LitPoint at = {{10.0, 0.0, 0.0}, {30.0, 25.0, 3.0}};
  const Vector3<double> normal = {1.0, 0.0, 0.0};
  for (const double spin : {0.0, 0.9}) {
    const LocalFrame frame = local_frame(Spacetime{spin}, at.point);
    LightRay ray{};
    RayCorrection correction = {};
    ASSERT_TRUE(light_ray(Spacetime{spin}, frame, at.point, at.lamp, 1, LightRayParts::way, correction, ray));
    // Finds the position of the ray after a third of its path from the point to the lamp.
    const Placed shell(make_sphere({}), {0.0, 0.0, 0.0}, 18.0);
    const MeshHit on_way = first_hit(frame.camera, ray.direction, {&shell.mesh, 1, 17.0, 19.0});
    ASSERT_EQ(on_way.mesh, 0);
    const Placed before(make_sphere({}), on_way.point, 0.5);
    const Placed beside(make_sphere({}), on_way.point + Vector3<double>{0.0, 0.0, 0.6}, 0.5);
    const double free = illuminance_of(spin, at, normal, {&beside.mesh, 1, 15.0, 20.0});
    EXPECT_GT(free, 0.0);
    // A ball in the path blocks the first path of the light. The light along the second path around
    // the hole arrives from elsewhere, and is much weaker.
    EXPECT_LT(illuminance_of(spin, at, normal, {&before.mesh, 1, 15.0, 20.0}), 0.01 * free) << spin;
  }
}

TEST(LampLight, IsNotTakenAwayByWhatStandsBehindTheLamp) {
  const LitPoint at = {{10.0, 0.0, 0.0}, {20.0, 0.0, 0.0}};
  const Placed behind(make_sphere({}), {24.0, 0.0, 0.0}, 2.0);
  EXPECT_GT(illuminance_of(0.0, at, {1.0, 0.0, 0.0}, {&behind.mesh, 1, 20.0, 27.0}), 0.0);
}

TEST(LampLight, ReachesASurfaceThatFacesAwayRoundTheHoleAlone) {
  const LitPoint at = {{10.0, 0.0, 0.0}, {30.0, 0.0, 0.1}};
  const Placed elsewhere(make_sphere({}), {0.0, 0.0, 90.0}, 1.0);
  const MeshScene scene = {&elsewhere.mesh, 1, 88.0, 92.0};
  const double round = illuminance(at.lamp, at.point, {-1.0, 0.0, 0.0}, 2, 100.0);
  EXPECT_GT(round, 0.0);
  // The computed rays end within 1e-6 of the surface, which limits the accuracy.
  EXPECT_NEAR(illuminance_of(0.0, at, {-1.0, 0.0, 0.0}, scene), round, 1e-6 * round);
}

TEST(LampLight, RoundTheHoleMeetsNothingThatItPasses) {
  // The ray goes around the hole and comes back past its start, which is 5 M from the center of the
  // ball. If its start is moved off the surface by a hundredth, a wrong treatment would let it hit
  // the ball.
  const LitPoint at = {{13.0, 0.0, 0.0}, {40.0, 0.0, 0.0}};
  const Placed ball(make_sphere({}), {15.0, 0.0, 0.0}, 1.99);
  const MeshScene scene = {&ball.mesh, 1, 12.0, 18.0};
  for (const double off : {1e-6, 1e-2}) {
    LampCorrections corrections = {};
    const LitSurfacePoint position = {at.point + Vector3<double>{0.0, 0.01, 0.0},
                                      {-1.0, 0.0, 0.0},
                                      {0.0, 0.0, 0.0},
                                      at.point + Vector3<double>{-off, 0.01, 0.0}};
    const LampLight light = lamp_light(Spacetime{0.0}, {at.lamp, 100.0}, position, scene, {1e-10, 4000}, corrections);
    EXPECT_GT(light.strength[1], 0.0) << off;
  }
}

//! A ball far away from all light, for scenes without shadows.
struct Elsewhere {
  Placed ball{make_sphere({}), {0.0, 0.0, 900.0}, 1.0};
  MeshScene scene{&ball.mesh, 1, 898.0, 902.0};
};

TEST(LampLight, FarFromTheHoleFadesWithTheSquareOfTheDistance) {
  const Elsewhere elsewhere;
  const LitPoint at = {{3e5, 0.0, 0.0}, {3e5, 100.0, 0.0}};
  for (const double spin : {0.0, 0.9}) {
    EXPECT_NEAR(illuminance_of(spin, at, {0.0, 1.0, 0.0}, elsewhere.scene, LampFalloff::lens), 0.01, 2e-7) << spin;
  }
}

//! Returns the number of photons that enter the sphere of radius r, from a lamp of strength 1 on
//! the spin axis, relative to the number that the lamp emits per unit of solid angle. Sums the
//! illuminance of the sphere's outside, per unit of time and area of a zero-angular-momentum
//! observer.
double photons_through_sphere(double spin, double r, double lamp_r) {
  const Elsewhere elsewhere;
  constexpr int count = 400;
  LampCorrections corrections = {};
  double sum = 0.0;
  for (int i = 0; i < count; ++i) {
    const double theta = pi * (i + 0.5) / count;
    const Vector3<double> point = point_at(r, theta, 0.3);
    const Vector3<double> normal = (1.0 / r) * point;
    const LampLight light =
        lamp_light(Spacetime{spin}, {{0.0, 0.0, lamp_r}, 1.0}, {point, normal, {0.0, 0.0, 0.0}, point}, elsewhere.scene,
                   {1e-10, 4000}, corrections);
    const KerrFunctions f = kerr_functions(Spacetime{spin}, r, theta);
    for (int way = 0; way < 2; ++way) {
      if (light.strength[way] > 0.0) {
        // A lamp's energy e_L and a zero-angular-momentum observer's energy e_R of a photon differ.
        // The rate at which photons arrive is e_R / e_L of the rate at which they are emitted, and
        // α e_L units of the observer's time pass per unit of the lamp's time.
        const double energy = 1.0 / detail::evaluate(light.frame.camera.energy, light.direction[way]);
        sum += 2.0 * pi * (pi / count) * std::sin(theta) * std::sqrt(f.area) * std::sqrt(f.sigma * f.delta / f.area) *
               energy * light.strength[way] * meeting(light, normal, light.direction[way]);
      }
    }
  }
  return sum;
}

// Light that enters inside the photon orbits does not come out again.
TEST(LampLight, ThroughASphereAboutTheHoleIsAllThatLessThanTwoHalfTurnsLeadThere) {
  constexpr double lamp_r = 12.0;
  const double through = photons_through_sphere(0.0, 2.2, lamp_r);
  const double angle = pi - connecting_ray(lamp_r, 2.2, 2.0 * pi).xi;
  const double sent = 2.0 * pi * (1.0 - std::cos(angle));
  EXPECT_NEAR(through, sent, 2e-4 * sent);
}

TEST(LampLight, ThroughASphereAboutAHoleThatSpinsIsAllOfItsShadowButTheLightOfFurtherWays) {
  constexpr double lamp_r = 12.0;
  const double through = photons_through_sphere(0.5, 2.2, lamp_r);
  const CameraStation camera = local_frame(Spacetime{0.5}, {0.0, 0.0, lamp_r}).camera;
  const ShadowChart chart = make_shadow_chart(camera);
  const double captured = 2.0 * pi * (1.0 - std::cos(edge_along_circle(camera, chart, 0.4, pi)));
  // Without spin, light along further paths contributes 0.8 % (previous test).
  EXPECT_NEAR(through, 0.992 * captured, 2e-3 * captured);
}

//! Returns the illuminance of a moving surface in its rest frame. v is its velocity, n its normal,
//! and d the direction of the light. Computed from the four-vectors of light, surface and matter.
double met_by_moving(const Vector3<double>& v, const Vector3<double>& n, const Vector3<double>& d) {
  using Four = std::array<double, 4>;
  const auto product = [](const Four& a, const Four& b) {
    return -a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
  };
  const double gamma = 1.0 / std::sqrt(1.0 - dot(v, v));
  const Four u = {gamma, gamma * v.x, gamma * v.y, gamma * v.z};
  const Four k = {1.0, -d.x, -d.y, -d.z};
  // The spatial normal n is perpendicular to the tangents of the surface. The four-vector of the
  // normal is also perpendicular to the four-velocity.
  Four normal = {dot(n, v), n.x, n.y, n.z};
  EXPECT_NEAR(product(normal, u), 0.0, 1e-12);
  const double size = std::sqrt(product(normal, normal));
  const double energy = -product(k, u);
  return energy * energy * -product(k, normal) / size / energy;
}

TEST(LampLight, OnASurfaceThatMovesIsWhatThatMeasures) {
  LampLight light{};
  light.frame = local_frame(Spacetime{0.0}, {1e12, 0.0, 0.0});
  light.velocity = {0.3, -0.5, 0.2};
  const Vector3<double> normal = {0.6, 0.0, 0.8};
  const Vector3<double> direction = {0.48, 0.6, 0.64};
  // Far from the hole, the axes of the local frame are e_r = x, e_θ = -z, e_φ = y.
  const Vector3<double> in_frame = {normal.x, -normal.z, normal.y};
  EXPECT_NEAR(meeting(light, normal, direction), met_by_moving(light.velocity, in_frame, direction), 1e-10);
  EXPECT_GT(meeting(light, normal, direction), 0.0);
}

TEST(LampLight, IsShiftedBetweenLampAndSurfaceWhereThatIsCalledFor) {
  const Elsewhere elsewhere;
  const LitPoint at = {{5.0, 0.0, 0.0}, {30.0, 0.0, 1.0}};
  LampCorrections corrections = {};
  const LitSurfacePoint position = {at.point, {1.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, at.point};
  const auto strength = [&](bool shifted) {
    const LampSource lamp = {at.lamp, 100.0, LampFalloff::lens, shifted};
    return lamp_light(Spacetime{0.0}, lamp, position, elsewhere.scene, {1e-10, 4000}, corrections).strength[0];
  };
  const double blueshift = static_frequency_ratio(length(at.lamp), 5.0);
  EXPECT_NEAR(strength(true) / strength(false), blueshift * blueshift, 1e-9);
}

TEST(LampLight, BehindTheHoleIsFinite) {
  const Elsewhere elsewhere;
  const double bright =
      illuminance_of(0.0, {{-10.0, 0.0, 0.0}, {30.0, 1e-9, 0.0}}, {0.0, 1.0, 0.0}, elsewhere.scene, LampFalloff::lens);
  EXPECT_GT(bright, 0.0);
  EXPECT_LT(bright, 1000.0 * 2.0 * 100.0 / (40.0 * 40.0));
}

}  // namespace
}  // namespace ergodome::test
