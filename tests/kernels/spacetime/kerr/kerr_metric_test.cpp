#include <gtest/gtest.h>

#include <cmath>

#include "kernels/core/angles.h"
#include "kernels/spacetime/kerr/camera_station.h"
#include "tests/kernels/reference_tables.h"

namespace ergodome {
namespace {

TEST(KerrMetric, RainReachesLightSpeedAtTheHorizon) {
  for (const double spin : {0.0, 0.5, 0.999, 1.0}) {
    EXPECT_NEAR(kerr_functions(Spacetime{spin}, horizon_radius(Spacetime{spin}), 1.0).rain_speed, 1.0, 1e-12) << spin;
  }
}

TEST(KerrMetric, DeltaKeepsItsDigitsRightAboveTheHorizon) {
  for (double above = 1e-2; above > 1e-15; above *= 0.1) {
    const double r = 1.0 + above;
    const double exact = (r - 1.0) * (r - 1.0);
    EXPECT_NEAR(kerr_functions(Spacetime{1.0}, r, 1.0).delta / exact, 1.0, 1e-15) << above;
    EXPECT_NEAR(kerr_functions(Spacetime{-1.0}, r, 1.0).delta / exact, 1.0, 1e-15) << above;
    EXPECT_EQ(kerr_functions(Spacetime{0.0}, 2.0 + above, 1.0).delta, (2.0 + above) * (2.0 + above - 2.0)) << above;
  }
}

TEST(CameraStation, LightStraightOutFromRightAboveAnExtremalHorizonIsShiftedByTheLapse) {
  for (double above = 1e-2; above > 1e-13; above *= 0.1) {
    const double r = 1.0 + above;
    const RayStart<double> ray = start_ray(make_camera_station(Spacetime{1.0}, r, pi / 2, 0.0, ObserverMotion::zamo),
                                           Vector3<double>{1.0, 0.0, 0.0});
    // In the equatorial plane, the lapse is α = r (r - 1) / √A, with A = r⁴ + r² + 2r.
    const double lapse = r * (r - 1.0) / std::sqrt(r * r * (r * r + 1.0) + 2.0 * r);
    EXPECT_NEAR(ray.energy / lapse, 1.0, 1e-12) << above;
  }
}

TEST(Observer, VelocitiesOfNamedObserversAreThoseOfTheReferenceTable) {
  for (const auto& ray : test::reference_rays()) {
    const Vector3<double> v = observer_velocity(ray.motion, Spacetime{ray.a}, ray.r, ray.theta, ray.beta);
    EXPECT_LT(test::length(v - ray.beta), 1e-14) << "ray " << ray.id;
  }
}

TEST(Observer, StaticObserverInTheErgosphereWouldOutrunLight) {
  const Vector3<double> v = observer_velocity(ObserverMotion::fixed, Spacetime{0.9}, 1.9, pi / 2, {});
  EXPECT_GE(test::length(v), 1.0);
}

TEST(Observer, CircularOrbitReachesLightSpeedAtThePhotonOrbit) {
  const double r = photon_orbit_radius(Spacetime{0.5}, 1.0);
  EXPECT_NEAR(test::length(observer_velocity(ObserverMotion::geodesic, Spacetime{0.5}, r, pi / 2, {})), 1.0, 1e-12);
}

TEST(Observer, BoostAndItsOppositeGiveBackTheVector) {
  const Vector3<double> beta = {0.3, -0.5, 0.6};
  const LorentzTransform there = boost_from_moving_frame(beta);
  const LorentzTransform back = boost_from_moving_frame(-beta);
  const LorentzTransform both = back * there;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      EXPECT_NEAR(both.row[i][j], i == j ? 1.0 : 0.0, 1e-14);
    }
  }
}

TEST(CameraStation, FrequencyRatioIsThatOfTheReferenceTableToRounding) {
  for (const auto& ray : test::reference_rays()) {
    const double energy = start_ray(test::station_of(ray), ray.n).energy;
    EXPECT_NEAR(1.0 / energy, ray.g, 1e-12 * std::abs(ray.g)) << "ray " << ray.id;
  }
}

TEST(CameraStation, RayFulfilsTheRadialAndThePolarFirstIntegral) {
  for (const auto& ray : test::reference_rays()) {
    const RayStart<double> s = start_ray(test::station_of(ray), ray.n);
    if (s.energy < 1e-3) {
      continue;
    }
    const double carter = s.polar_constant - s.axial_angular_momentum * s.axial_angular_momentum;
    const double potential = 1.0 + (ray.a * ray.a - s.polar_constant) * s.u * s.u +
                             2.0 * s.shear_constant * s.u * s.u * s.u - ray.a * ray.a * carter * std::pow(s.u, 4);
    const double scale = 1.0 + s.polar_constant * s.u * s.u;
    EXPECT_NEAR(s.u_rate * s.u_rate, potential, 1e-12 * scale) << "ray " << ray.id;
    EXPECT_NEAR(dot(s.m, s.m_rate), 0.0, 1e-12 * (1.0 + s.polar_constant)) << "ray " << ray.id;
    EXPECT_GE(s.shear_constant, -1e-12 * (1.0 + s.polar_constant)) << "ray " << ray.id;
  }
}

TEST(CameraStation, RainFrameWorksOnTheHorizonItself) {
  const double r = horizon_radius(Spacetime{0.9});
  const CameraStation camera = make_camera_station(Spacetime{0.9}, r, 1.0, 0.0, ObserverMotion::rain);
  const RayStart<double> ray = start_ray(camera, Vector3<double>{0.6, 0.0, 0.8});
  EXPECT_TRUE(std::isfinite(ray.u_rate));
  EXPECT_GT(ray.energy, 0.0);
}

TEST(CameraStation, ZamoJustOutsideTheHorizonStillHasFiniteRaysInFloat) {
  const double r = horizon_radius(Spacetime{0.999}) + 1e-6;
  const CameraStation camera = make_camera_station(Spacetime{0.999}, r, 1.2, 0.0, ObserverMotion::zamo);
  const RayStart<double> exact = start_ray(camera, Vector3<double>{1.0, 0.0, 0.0});
  const RayStart<float> narrow = start_ray(converted_station<float>(camera), Vector3<float>{1.0F, 0.0F, 0.0F});
  EXPECT_NEAR(narrow.u_rate, exact.u_rate, 1e-5 * std::abs(exact.u_rate));
  EXPECT_NEAR(narrow.energy, exact.energy, 1e-6 * std::abs(exact.energy));
}

}  // namespace
}  // namespace ergodome
