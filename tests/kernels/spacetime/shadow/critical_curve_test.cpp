#include "kernels/spacetime/shadow/critical_curve.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kernels/core/angles.h"
#include "tests/kernels/reference_tables.h"

namespace ergodome {
namespace {

TEST(CriticalCurve, PassesThroughEveryPointOfTheReferenceTable) {
  for (const auto& point : test::reference_edge()) {
    const CameraStation camera = test::station_of(point);
    const ShadowChart chart = make_shadow_chart(camera);
    EXPECT_LT(std::abs(edge_distance(camera, chart, point.n)), 1e-10) << "camera " << point.camera;
  }
}

TEST(CriticalCurve, DistanceIsThatOfTheReferenceRaysOfZeroAngularMomentumObservers) {
  for (const auto& ray : test::reference_rays()) {
    if (ray.edge_distance == -1.0 || ray.motion != ObserverMotion::zamo) {
      continue;  // the angle is relative to the chart's center, which differs between observers
    }
    const CameraStation camera = test::station_of(ray);
    const ShadowChart chart = make_shadow_chart(camera);
    EXPECT_NEAR(edge_distance(camera, chart, ray.n), ray.edge_distance, 1e-10) << "ray " << ray.id;
  }
}

TEST(CriticalCurve, StaticSchwarzschildShadowIsSynges) {
  // Angle of the shadow's edge by Synge, MNRAS 131 (1966) 463: sin²ξ = 27 (1 - 2/r) / r². The angle
  // is acute outside r = 3.
  for (const double r : {2.001, 2.5, 2.999, 3.0, 3.001, 5.0, 40.0, 1e6}) {
    const CameraStation camera = make_camera_station(Spacetime{0.0}, r, 1.0, 0.0, ObserverMotion::zamo);
    const ShadowChart chart = make_shadow_chart(camera);
    const double sine = std::sqrt(27.0 * (1.0 - 2.0 / r)) / r;
    const double acute = std::asin(std::min(1.0, sine));
    const double expected = r >= 3.0 ? acute : pi - acute;
    // At r = 3, the shadow fills half of the sky, and the arcsine in the expected value loses half
    // of its digits.
    const double tolerance = std::abs(r - 3.0) < 1e-2 ? 1e-7 : 1e-12;
    EXPECT_NEAR(edge_polar_angle(camera, chart, 0.7), expected, tolerance * expected) << "r " << r;
  }
}

TEST(CriticalCurve, ShadowAtThePhotonOrbitIsHalfTheSky) {
  const CameraStation camera = make_camera_station(Spacetime{0.0}, 3.0, 1.0, 0.0, ObserverMotion::zamo);
  EXPECT_NEAR(edge_polar_angle(camera, make_shadow_chart(camera), 2.0), pi / 2, 1e-14);
}

TEST(CriticalCurve, SeenFromFarTheProgradeEdgeLiesAtItsImpactParameter) {
  // Impact parameters of equatorial photon orbits (Bardeen 1973): L = -(r³ - 3r² + a² r + a²) / (a
  // (r - 1)) for the orbit with the radius r.
  const double a = 0.9;
  const double r = 1e6;
  const CameraStation camera = make_camera_station(Spacetime{a}, r, pi / 2, 0.0, ObserverMotion::zamo);
  const auto impact = [&](double orbit) {
    return -(orbit * orbit * orbit - 3.0 * orbit * orbit + a * a * orbit + a * a) / (a * (orbit - 1.0));
  };
  const double prograde = impact(photon_orbit_radius(Spacetime{a}, 1.0));
  const double retrograde = impact(photon_orbit_radius(Spacetime{a}, -1.0));
  const ShadowChart chart = make_shadow_chart(camera);
  const double width = edge_polar_angle(camera, chart, 0.0) + edge_polar_angle(camera, chart, pi);
  EXPECT_NEAR(width * r, prograde - retrograde, 2e-5);
}

TEST(CriticalCurve, IsMirroredWhenTheSpinIs) {
  const CameraStation plus = make_camera_station(Spacetime{0.9}, 4.0, 1.1, 0.0, ObserverMotion::zamo);
  const CameraStation minus = make_camera_station(Spacetime{-0.9}, 4.0, 1.1, 0.0, ObserverMotion::zamo);
  const ShadowChart chart = make_shadow_chart(plus);
  for (const double gamma : {0.1, 1.0, 2.0, 3.0, 4.0, 5.5}) {
    const double alpha = edge_polar_angle(plus, chart, gamma);
    Vector3<double> n = chart_direction<double>(chart, std::cos(alpha), std::sin(alpha), gamma);
    n.z = -n.z;
    EXPECT_NEAR(edge_distance(minus, make_shadow_chart(minus), n), 0.0, 1e-12);
  }
}

TEST(CriticalCurve, IsContinuousAsTheSpinGoesToZero) {
  const CameraStation none = make_camera_station(Spacetime{0.0}, 5.0, 1.0, 0.0, ObserverMotion::zamo);
  const CameraStation tiny = make_camera_station(Spacetime{1e-12}, 5.0, 1.0, 0.0, ObserverMotion::zamo);
  for (const double gamma : {0.0, 1.0, 3.0}) {
    EXPECT_NEAR(edge_polar_angle(none, make_shadow_chart(none), gamma),
                edge_polar_angle(tiny, make_shadow_chart(tiny), gamma), 1e-11);
  }
}

TEST(CriticalCurve, OfTheExtremalHoleHasTheStraightSideOfAngularMomentumTwo) {
  // For a = 1, light at the prograde side of the shadow has L = 2, and its double root is at the
  // horizon.
  const CameraStation camera = make_camera_station(Spacetime{1.0}, 1e3, pi / 2, 0.0, ObserverMotion::zamo);
  const ShadowChart chart = make_shadow_chart(camera);
  for (const double gamma : {pi - 0.2, pi, pi + 0.2}) {
    const double alpha = edge_polar_angle(camera, chart, gamma);
    const Vector3<double> n = chart_direction<double>(chart, std::cos(alpha), std::sin(alpha), gamma);
    EXPECT_NEAR(start_ray(camera, n).axial_angular_momentum, 2.0, 1e-8) << "gamma " << gamma;
  }
}

//! Expects that rays become bright only once along each great circle from the center of the chart:
//! at the critical curve.
void expect_star_shaped(double a, double r, double theta, ObserverMotion motion, const Vector3<double>& beta) {
  const CameraStation camera = make_camera_station(Spacetime{a}, r, theta, 0.0, motion, beta);
  const ShadowChart chart = make_shadow_chart(camera);
  int wrong = 0;
  for (int g = 0; g < 16; ++g) {
    const double gamma = 2.0 * pi * g / 16;
    const double edge = edge_polar_angle(camera, chart, gamma);
    for (int k = 1; k < 48; ++k) {
      const double alpha = pi * k / 48;
      const Vector3<double> n = chart_direction<double>(chart, std::cos(alpha), std::sin(alpha), gamma);
      const bool close = std::abs(alpha - edge) < 1e-3 * edge;
      wrong += !close && direction_is_bright(camera, n) != (alpha > edge) ? 1 : 0;
    }
  }
  EXPECT_EQ(wrong, 0) << "a " << a << " r " << r << " theta " << theta;
}

TEST(CriticalCurve, DividesTheSkyOfEveryCameraIntoOneDarkAndOneBrightPart) {
  for (const double a : {0.0, 0.5, 0.999, 1.0 - 1e-6, 1.0, -0.7, -1.0}) {
    for (const double above : {1e-6, 1e-3, 0.05, 0.3, 1.0, 2.0, 5.0, 1e3, 1e6}) {
      for (const double theta : {0.0, 1e-9, 0.1, 1.5707963267948966, 2.5}) {
        const double r = horizon_radius(Spacetime{a}) + above;
        expect_star_shaped(a, r, theta, ObserverMotion::zamo, {});
        expect_star_shaped(a, r, theta, ObserverMotion::rain, {});
        expect_star_shaped(a, r, theta, ObserverMotion::velocity, {0.3, -0.4, 0.5});
      }
    }
  }
}

}  // namespace
}  // namespace ergodome
