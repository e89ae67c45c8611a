#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "kernels/core/angles.h"
#include "kernels/disk/crossing_layers.h"
#include "kernels/eyes/flat/eye_line.h"
#include "kernels/near_rays/near_pixels.h"
#include "kernels/shells/shell_crossings.h"

// Tests of the layers of the stereo model `flat`: surfaces in the flat tangent space of the head,
// at the affine distance of an image. Checks these distances, and where an eye's line of sight
// meets a layer.
namespace ergodome {
namespace {

using D = Dual<double>;

//! Returns a direction with derivatives along two perpendicular directions.
Vector3<D> direction_with_derivatives(const Vector3<double>& n) {
  const Vector3<double> helper = std::abs(n.x) < 0.9 ? Vector3<double>{1, 0, 0} : Vector3<double>{0, 1, 0};
  Vector3<double> x = cross(helper, n);
  x = (1.0 / std::sqrt(dot(x, x))) * x;
  const Vector3<double> y = cross(n, x);
  return {D(n.x, x.x, y.x), D(n.y, x.y, y.y), D(n.z, x.z, y.z)};
}

Vector3<double> unit(const Vector3<double>& v) { return (1.0 / std::sqrt(dot(v, v))) * v; }

//! The affine distances at which a ray meets the equatorial plane and a sphere. They are computed
//! by the fourth-order Runge-Kutta method in Mino time, from equations for r and cosθ, which differ
//! from those of the Taylor series.
struct MetDistances {
  std::vector<double> plane;
  std::vector<double> plane_u;
  std::vector<double> sphere;
};

MetDistances integrated(const CameraStation& camera, const Vector3<double>& n, double sphere_r) {
  const NearRay<double> ray = start_near_ray(camera, n);
  const double a = camera.spin;
  const double e = ray.energy;
  const double l = ray.axial_angular_momentum;
  struct State {
    double r, r_rate, z, z_rate, distance;
  };
  const auto rate = [&](const State& s) {
    const double x = e * (s.r * s.r + a * a) - a * l;
    return State{s.r_rate, 2.0 * e * s.r * x - (s.r - 1.0) * ray.shear_constant, s.z_rate,
                 -(ray.polar_constant - a * a * e * e) * s.z - 2.0 * a * a * e * e * s.z * s.z * s.z,
                 s.r * s.r + a * a * s.z * s.z};
  };
  const auto moved = [](const State& s, double h, const State& d) {
    return State{s.r + h * d.r, s.r_rate + h * d.r_rate, s.z + h * d.z, s.z_rate + h * d.z_rate,
                 s.distance + h * d.distance};
  };
  const double r0 = 1.0 / camera.u;
  State s = {r0, -r0 * r0 * ray.u_rate, ray.m.z, ray.m_rate.z, 0.0};
  MetDistances met;
  for (int i = 0; i < 400'000 && s.r > camera.horizon_r * 1.02 && s.r < 40.0; ++i) {
    const double h = 2e-4 / s.r;
    const State k1 = rate(s);
    const State k2 = rate(moved(s, 0.5 * h, k1));
    const State k3 = rate(moved(s, 0.5 * h, k2));
    const State k4 = rate(moved(s, h, k3));
    const State next = moved(moved(moved(moved(s, h / 6, k1), h / 3, k2), h / 3, k3), h / 6, k4);
    const auto between = [&](double before, double after) { return before / (before - after); };
    if (s.z * next.z < 0.0) {
      const double part = between(s.z, next.z);
      met.plane.push_back(s.distance + part * (next.distance - s.distance));
      met.plane_u.push_back(1.0 / (s.r + part * (next.r - s.r)));
    }
    if ((s.r - sphere_r) * (next.r - sphere_r) < 0.0) {
      met.sphere.push_back(s.distance + between(s.r - sphere_r, next.r - sphere_r) * (next.distance - s.distance));
    }
    s = next;
  }
  return met;
}

//! A visitor that collects the affine distances at which a ray crosses shells.
struct CrossedDistances {
  std::vector<double> distances;
  void cross(int, bool, const NearPosition<double>& position) { distances.push_back(position.distance); }
  void turn(bool, const NearPosition<double>&) {}
  static bool done() { return false; }
};

TEST(FlatLayers, AreAsFarAsAnIndependentIntegrationHasThem) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  for (const double spin : {0.0, 0.9, -0.999}) {
    const CameraStation camera = make_camera_station(Spacetime{spin}, 14.0, 1.2, 0.4, ObserverMotion::geodesic);
    int planes = 0;
    int spheres = 0;
    for (int i = 0; i < 40; ++i) {
      const Vector3<double> n = unit({-6.0 + normal(random), normal(random), normal(random)});
      const MetDistances expected = integrated(camera, n, 5.0);
      CrossingLayer<double> layers[crossing_orders];
      const LayerLimits<double> limits = {0.97 / camera.horizon_r, 1.0 / 50.0, 1.5, -0.5, 1e-12, 400};
      const NearRay<double> ray = start_near_ray(camera, n);
      trace_layers<14, NearParts::distance>(spin, ray, limits, layers);
      for (std::size_t k = 0; k < expected.plane.size() && k < crossing_orders; ++k) {
        // Closer to the hole than this limit, layers are linear continuations, without exact
        // distances.
        if (expected.plane_u[k] > limits.near_u) {
          break;
        }
        EXPECT_NEAR(layers[k].distance, expected.plane[k], 2e-6 * expected.plane[k]) << spin << " " << i << " " << k;
        EXPECT_NEAR(layers[k].u, expected.plane_u[k], 1e-5) << spin << " " << i << " " << k;
        ++planes;
      }
      CrossedDistances crossed;
      const double u = 0.2;
      trace_shells<14, NearParts::azimuth_and_distance>(spin, ray, ShellRadii<double>{&u, 1}, {1e-12, 400}, true,
                                                        crossed);
      ASSERT_EQ(crossed.distances.size(), expected.sphere.size()) << spin << " " << i;
      for (std::size_t k = 0; k < expected.sphere.size(); ++k) {
        EXPECT_NEAR(crossed.distances[k], expected.sphere[k], 2e-6 * expected.sphere[k]) << spin << " " << i;
        ++spheres;
      }
    }
    EXPECT_GT(planes, 20);
    EXPECT_GT(spheres, 20);
  }
}

TEST(FlatLayers, AreMetWhereALineMeetsAPlane) {
  const Vector3<double> eye = {0.3, -0.4, 0.2};
  const LayerSearch<double> search = {2.0, 1e-12};
  // The layer is the plane z = -1. In direction n, its distance is 1 / -n_z, so its nearness is
  // -n_z.
  const auto nearness = [](const EyePoint<double>& point, bool) { return -point.n.z; };
  for (const Vector3<double>& m : {unit({1.0, 0.2, -0.5}), unit({-0.3, 0.1, -1.0}), unit({0.5, -2.0, -0.4})}) {
    const auto meet = [&](const Vector3<D>& direction) {
      return meet_layer(EyeLine<double>{direction, eye}, 0.0, search, true, nearness);
    };
    const Vector3<D> direction = direction_with_derivatives(m);
    const MetLayer<double> met = meet(direction);
    ASSERT_TRUE(met.met);
    const double way = (-1.0 - eye.z) / m.z;
    EXPECT_NEAR(met.nearness(), 1.0 / way, 1e-12);
    const Vector3<double> position = eye + way * m;
    const Vector3<double> n = unit(position);
    const Vector3<D> found = met.direction();
    EXPECT_NEAR(found.x.value, n.x, 1e-12);
    EXPECT_NEAR(found.y.value, n.y, 1e-12);
    EXPECT_NEAR(found.z.value, n.z, 1e-12);
    // The derivative of the direction along its second axis must agree with differences between
    // intersections.
    constexpr double step = 1e-6;
    const Vector3<double> aside =
        unit({m.x + step * direction.x.along_y, m.y + step * direction.y.along_y, m.z + step * direction.z.along_y});
    const Vector3<double> beside = unit(eye + ((-1.0 - eye.z) / aside.z) * aside);
    EXPECT_NEAR(found.x.along_y, (beside.x - n.x) / step, 1e-5);
    EXPECT_NEAR(found.z.along_y, (beside.z - n.z) / step, 1e-5);
  }
}

TEST(FlatLayers, AreMetWhereParallaxHasThem) {
  const Vector3<double> eye = {0.0, 0.5, 0.0};
  // The layer is a sphere around the head, with the same distance in all directions. seen_by_head()
  // is the closed form for it.
  for (const double distance : {1.0, 5.0, 1e4}) {
    const auto nearness = [&](const EyePoint<double>&, bool) { return D(1.0 / distance); };
    const Vector3<double> m = unit({1.0, 0.7, -0.3});
    const MetLayer<double> met = meet_layer(EyeLine<double>{direction_with_derivatives(m), eye}, 0.0,
                                            LayerSearch<double>{1.8, 1e-13}, true, nearness);
    ASSERT_TRUE(met.met);
    const Vector3<double> n = seen_by_head(m, distance, eye);
    EXPECT_NEAR(met.direction().y.value, n.y, 1e-12) << distance;
    EXPECT_NEAR(met.direction().z.value, n.z, 1e-12) << distance;
  }
}

TEST(FlatLayers, AreNotMetWhereTheirDistanceLeaps) {
  // The layer is near in one part of the sky and far in the other; its distance jumps between them.
  const auto nearness = [](const EyePoint<double>& point, bool) { return point.n.y.value > 0.1 ? D(1.0) : D(0.01); };
  const Vector3<double> eye = {0.0, 0.5, 0.0};
  int layers[2] = {0, 0};
  int leaps = 0;
  for (int i = 0; i <= 200; ++i) {
    const Vector3<double> m = unit({1.0, -0.6 + 0.005 * i, 0.0});
    const MetLayer<double> met = meet_layer(EyeLine<double>{direction_with_derivatives(m), eye}, 0.0,
                                            LayerSearch<double>{1.8, 1e-9}, true, nearness);
    // If an intersection is reported, it must be on the layer.
    if (met.met) {
      const EyePoint<double> there = EyeLine<double>{direction_with_derivatives(m), eye}.at(met.nearness());
      EXPECT_NEAR(met.nearness(), there.length.value * nearness(there, true).value, 1e-8) << i;
      ++layers[there.n.y.value > 0.1 ? 1 : 0];
    } else {
      ++leaps;
    }
  }
  EXPECT_GT(layers[0], 50);
  EXPECT_GT(layers[1], 50);
  // Some lines of sight pass through the gap between the two parts of the layer and meet neither.
  EXPECT_LT(leaps, 80);
}

}  // namespace
}  // namespace ergodome
