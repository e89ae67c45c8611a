#include "kernels/objects/mesh_rays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "kernels/core/angles.h"
#include "kernels/spacetime/geodesic/radial_potential.h"
#include "kernels/spacetime/schwarzschild/apparent_position.h"
#include "tests/kernels/mesh_scene.h"
#include "tests/kernels/reference_tables.h"

namespace ergodome::test {
namespace {

Vector3<double> unit(const Vector3<double>& v) { return (1.0 / length(v)) * v; }

//! Converts the components of a vector from pseudo-Cartesian axes to (e_r, e_θ, e_φ).
Vector3<double> in_polar_axes(const Vector3<double>& v, double theta, double phi) {
  const Vector3<double> e_r = {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
  const Vector3<double> e_theta = {std::cos(theta) * std::cos(phi), std::cos(theta) * std::sin(phi), -std::sin(theta)};
  return {dot(v, e_r), dot(v, e_theta), dot(v, cross(e_r, e_theta))};
}

TEST(MeshRays, MeetSmallTrianglesWhereTheClosedFormSendsThem) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int i = 0; i < 300; ++i) {
    const double camera_r = 4.0 + 40.0 * share(random);
    const double theta = std::acos(2.0 * share(random) - 1.0);
    const double phi = 2.0 * pi * share(random);
    const CameraStation camera = make_camera_station(Spacetime{0.0}, camera_r, theta, phi, ObserverMotion::fixed);
    const Vector3<double> observer =
        camera_r * Vector3<double>{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
    const double r = 3.2 + 30.0 * share(random);
    const double height = 2.0 * share(random) - 1.0;
    const double azimuth = 2.0 * pi * share(random);
    const double beside = std::sqrt(1.0 - height * height);
    const Vector3<double> point = r * Vector3<double>{beside * std::cos(azimuth), beside * std::sin(azimuth), height};
    const int order = 1 + i % 2;
    const ApparentPosition seen = apparent_position(observer, point, order);
    const Vector3<double> away =
        std::abs(seen.emission_direction.x) < 0.7 ? Vector3<double>{1.0, 0.0, 0.0} : Vector3<double>{0.0, 1.0, 0.0};
    const Vector3<double> side = unit(cross(seen.emission_direction, away));
    const Placed placed(triangle_about(side, cross(seen.emission_direction, side)), point, 1e-3);
    const MeshHit hit =
        first_hit(camera, in_polar_axes(seen.direction, theta, phi), {&placed.mesh, 1, r - 0.01, r + 0.01});
    ASSERT_EQ(hit.mesh, 0) << i;
    EXPECT_LT(length(hit.point - point), 1e-8 * r) << i;
    EXPECT_NEAR(hit.delay, seen.travel_time, 1e-8 * seen.travel_time) << i;
    EXPECT_NEAR(hit.weight_1, 1.0 / 3.0, 1e-3) << i;
  }
}

TEST(MeshRays, MeetAPlaneAboutASpinningHoleWhereTheReferenceTableHasItsCrossings) {
  constexpr float far = 64.0F;
  TriangleMesh square;
  for (const auto& [x, y] : {std::pair{-far, -far}, {far, -far}, {far, far}, {-far, far}}) {
    square.vertices.push_back({{x, y, 0.0F}, {0.0F, 0.0F, 1.0F}, {0.0F, 0.0F}});
  }
  square.indices = {0, 1, 2, 0, 2, 3};

  const Placed placed(square, {0.0, 0.0, 0.0}, 1.0);
  int compared = 0;
  for (const ReferenceCrossing& row : reference_crossings()) {
    // Skips cameras in the equatorial plane: from there, every ray meets the plane at the camera
    // itself.
    if (row.order != 0 || row.r_hit > 60.0 || row.r > 1e4 || std::abs(row.theta - 0.5 * pi) < 1e-12) {
      continue;
    }
    const MeshHit hit =
        first_hit(station_of(row), row.n, {&placed.mesh, 1, horizon_radius(Spacetime{row.a}) * 1.0001, 100.0});
    ASSERT_EQ(hit.mesh, 0) << row.id;
    EXPECT_NEAR(length(hit.point), row.r_hit, 1e-9 * row.r_hit) << row.id;
    const double phi = std::atan2(hit.point.y, hit.point.x);
    EXPECT_LT(std::abs(std::remainder(phi - row.phi_hit, 2.0 * pi)), 1e-9) << row.id;
    EXPECT_NEAR(hit.delay, row.delay, 1e-8) << row.id;
    EXPECT_NEAR(hit.point.z, 0.0, 1e-12) << row.id;
    ++compared;
  }
  EXPECT_GT(compared, 30);
}

//! Light that passes the hole and is symmetric about the x axis, where it is closest, at r = 5.
//! Near this point its path is x = 5 - 1.5 φ².
struct GrazingLight {
  static constexpr double turn_r = 5.0;
  double camera_r = 12.0;
  CameraStation camera;
  Vector3<double> n;

  GrazingLight() {
    const double turn = 1.0 / turn_r;
    const TurningOrbit orbit = turning_orbit(turn, 1.0 / 3.0 - turn, 0.5 - turn, 1.0);
    const double angle = leg_from_turn(orbit, turn - 1.0 / camera_r).angle;
    const double sine = std::sqrt((1.0 - 2.0 / camera_r) / orbit.inverse_b_squared) / camera_r;
    camera = make_camera_station(Spacetime{0.0}, camera_r, 0.5 * pi, angle, ObserverMotion::fixed);
    n = {-std::sqrt(1.0 - sine * sine), 0.0, -sine};
  }
};

TEST(MeshRays, GrazeATriangleTwiceAndMeetItTheFirstTime) {
  const GrazingLight light;
  for (const double depth : {0.05, 1e-3, 1e-5, 1e-7}) {
    const Placed placed(triangle_about({0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}), {GrazingLight::turn_r - depth, 0.0, 0.0},
                        1.0);
    const MeshHit hit = first_hit(light.camera, light.n, {&placed.mesh, 1, 4.0, 7.0});
    ASSERT_EQ(hit.mesh, 0) << depth;
    EXPECT_NEAR(hit.point.x, GrazingLight::turn_r - depth, 1e-9) << depth;
    const double expected = GrazingLight::turn_r * std::sqrt(depth / 1.5);
    EXPECT_NEAR(hit.point.y, expected, 0.02 * expected + 1e-6) << depth;
  }
}

TEST(MeshRays, PassATriangleThatTheyDoNotReach) {
  const GrazingLight light;
  for (const double gap : {0.05, 1e-3, 1e-5, 1e-7}) {
    const Placed placed(triangle_about({0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}), {GrazingLight::turn_r + gap, 0.0, 0.0}, 1.0);
    EXPECT_EQ(first_hit(light.camera, light.n, {&placed.mesh, 1, 4.0, 7.0}).mesh, -1) << gap;
  }
}

TEST(MeshRays, MeetASphereAboutCameraAndHoleUnlessTheyComeFromTheHole) {
  const Placed placed(make_sphere({}), {0.0, 0.0, 0.0}, 20.0);
  const CameraStation camera = make_camera_station(Spacetime{0.998}, 8.0, 1.1, 0.4, ObserverMotion::zamo);
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  int dark = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector3<double> n = unit({normal(random), normal(random), normal(random)});
    const bool bright = comes_from_sky(camera.spin, camera.horizon_r, start_ray(camera, n));
    EXPECT_EQ(first_hit(camera, n, {&placed.mesh, 1, 15.0, 21.0}).mesh, bright ? 0 : -1) << i;
    dark += bright ? 0 : 1;
  }
  EXPECT_GT(dark, 100);
}

TEST(MeshRays, StopAtTheNearerOfTwoMeshes) {
  const CameraStation camera = make_camera_station(Spacetime{0.5}, 30.0, 0.5 * pi, 0.0, ObserverMotion::zamo);
  const Placed near(make_sphere({}), {20.0, 0.0, 0.0}, 0.5);
  const Placed far(make_sphere({}), {12.0, 0.0, 0.0}, 2.0);
  for (const bool swapped : {false, true}) {
    const PlacedMesh both[2] = {swapped ? far.mesh : near.mesh, swapped ? near.mesh : far.mesh};
    EXPECT_EQ(first_hit(camera, {-1.0, 0.0, 0.0}, {both, 2, 9.0, 21.0}).mesh, swapped ? 1 : 0);
  }
}

TEST(MeshRays, SeeAMeshThatIsTurned) {
  // A triangle in the plane x = 0 of its own coordinates, rotated about z by 1 rad. Rays are
  // converted to these coordinates by the transposed matrix.
  Placed placed(triangle_about({0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}), {10.0, 0.0, 0.0}, 0.5);
  const CameraStation camera = make_camera_station(Spacetime{0.0}, 30.0, 0.5 * pi, 0.0, ObserverMotion::fixed);
  const double c = std::cos(1.0);
  const double s = std::sin(1.0);
  const double rows[3][3] = {{c, -s, 0.0}, {s, c, 0.0}, {0.0, 0.0, 1.0}};
  std::copy(&rows[0][0], &rows[0][0] + 9, &placed.mesh.rows[0][0]);
  const MeshHit hit = first_hit(camera, unit({-1.0, 0.0, 0.001}), {&placed.mesh, 1, 8.0, 12.0});
  ASSERT_EQ(hit.mesh, 0);
  // The hit is in the rotated plane.
  EXPECT_NEAR((hit.point.x - 10.0) * c + hit.point.y * s, 0.0, 1e-9);
}

TEST(TriangleTree, LeadsToEveryTriangleThatASegmentCrosses) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> position(-1.0F, 1.0F);
  TriangleMesh soup;
  for (std::uint32_t i = 0; i < 3 * 3000; ++i) {
    const float scale = i % 7 == 0 ? 1.0F : 0.1F;
    soup.vertices.push_back({{position(random), scale * position(random), scale * position(random)}, {}, {}});
    soup.indices.push_back(i);
  }

  const TriangleBoxes boxes = build_triangle_tree(soup);
  std::vector<std::uint32_t> order = boxes.triangles;
  std::sort(order.begin(), order.end());
  for (std::uint32_t i = 0; i < 3000; ++i) {
    ASSERT_EQ(order[i], i);
  }
  long crossed = 0;
  for (int i = 0; i < 300; ++i) {
    const auto p = [&] { return Vector3<double>{position(random), position(random), position(random)}; };
    const Vector3<double> from = p();
    const Vector3<double> to = i % 10 == 0 ? Vector3<double>{from.x, from.y, -from.z} : p();
    std::vector<bool> visited(3000);
    visit_triangles(boxes.view(), from, to, 1e-6, [&](std::uint32_t at) { visited[at] = true; });
    for (std::uint32_t at = 0; at < 3000; ++at) {
      const TriangleSides t = triangle_sides(boxes.view(), at);
      const Vector3<double> normal = cross(t.side_1, t.side_2);
      const double share = dot(normal, t.corner - from) / dot(normal, to - from);
      const Vector3<double> w = from + share * (to - from) - t.corner;
      const double b1 = dot(cross(w, t.side_2), normal) / dot(normal, normal);
      const double b2 = dot(cross(t.side_1, w), normal) / dot(normal, normal);
      if (share >= 0.0 && share <= 1.0 && b1 >= 0.0 && b2 >= 0.0 && b1 + b2 <= 1.0) {
        EXPECT_TRUE(visited[at]) << i << " " << at;
        ++crossed;
      }
    }
  }
  EXPECT_GT(crossed, 1000);
}

//! A curved path: a cubic function of its parameter, with these coefficients.
struct BentPath {
  Vector3<double> start, speed, bow, skew;
  Vector3<double> operator()(double h) const { return start + h * (speed + h * (bow + h * skew)); }
};

//! Finds the parameter at which a path crosses a triangle, by many small steps. Returns more than 1
//! if it does not cross it between 0 and 1.
double first_crossing(const BentPath& path, const TriangleSides& t) {
  constexpr int steps = 2000;
  const Vector3<double> normal = cross(t.side_1, t.side_2);
  double before = dot(normal, path(0.0) - t.corner);
  for (int i = 1; i <= steps; ++i) {
    const double h = static_cast<double>(i) / steps;
    const double now = dot(normal, path(h) - t.corner);
    if ((before < 0.0) != (now < 0.0)) {
      const double at = h - now / (now - before) / steps;
      const Vector3<double> w = path(at) - t.corner;
      const double b1 = dot(cross(w, t.side_2), normal) / dot(normal, normal);
      const double b2 = dot(cross(t.side_1, w), normal) / dot(normal, normal);
      if (b1 >= 0.0 && b2 >= 0.0 && b1 + b2 <= 1.0) {
        return at;
      }
    }
    before = now;
  }
  return 2.0;
}

TEST(PathParabola, LeavesOutNoTriangleThatThePathCrossesAndMostOfTheOthers) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  const auto vector = [&](double size) { return size * Vector3<double>{share(random), share(random), share(random)}; };
  int crossed = 0;
  int passed = 0;
  int kept = 0;
  for (int i = 0; i < 4000; ++i) {
    // Paths are between nearly straight and more curved than any piece of a ray in a search for
    // objects.
    const double bent = std::pow(10.0, -1.5 + 1.5 * share(random));
    const BentPath path = {vector(1.0), vector(1.0), vector(0.3 * bent), vector(0.1 * bent)};
    const TriangleSides t = {path(0.5 + 0.6 * share(random)) + vector(0.15), vector(0.2), vector(0.2)};
    const PathPiece piece = {0.0, 1.0, path(0.0), path(0.5), path(1.0)};
    const Vector3<double> normal = cross(t.side_1, t.side_2);
    const auto f = [&](double h) { return dot(normal, path(h) - t.corner); };
    const double at = first_crossing(path, t);
    const PathParabola parabola = parabola_of(piece, path, 1.0);
    const PlaneOnPiece plane = {t, normal, f(0.0), f(0.5), f(1.0)};
    if (at <= 1.0) {
      EXPECT_TRUE(may_cross(parabola, plane, 2.0)) << i;
      EXPECT_TRUE(may_cross(parabola, plane, at)) << i;
      ++crossed;
    } else {
      kept += may_cross(parabola, plane, 2.0) ? 1 : 0;
      ++passed;
    }
  }
  EXPECT_GT(crossed, 100);
  EXPECT_LT(kept, passed / 5);
}

TEST(TriangleTree, OfTrianglesInOnePlaceIsNoDeeperThanItMayBe) {
  TriangleMesh stack;
  stack.vertices = {{{0.0F, 0.0F, 0.0F}, {}, {}}, {{1.0F, 0.0F, 0.0F}, {}, {}}, {{0.0F, 1.0F, 0.0F}, {}, {}}};
  for (std::uint32_t i = 0; i < 3 * 10'000; ++i) {
    stack.indices.push_back(i % 3);
  }

  const TriangleBoxes boxes = build_triangle_tree(stack);
  long visited = 0;
  visit_triangles(boxes.view(), {0.2, 0.2, -1.0}, {0.2, 0.2, 1.0}, 0.0, [&](std::uint32_t) { ++visited; });
  EXPECT_EQ(visited, 10'000);
}

}  // namespace
}  // namespace ergodome::test
