#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernels/core/angles.h"
#include "kernels/spacetime/geodesic/baseline_rk34.h"
#include "kernels/spacetime/geodesic/closed_form.h"
#include "kernels/spacetime/geodesic/runge_kutta.h"
#include "kernels/spacetime/geodesic/taylor.h"
#include "kernels/spacetime/shadow/critical_curve.h"
#include "tests/kernels/reference_tables.h"

namespace ergodome {
namespace {

using test::ReferenceRay;

//! Calls check(ray, start of the ray) for each ray of the table that comes from the sky.
template <class Check>
void for_each_escaped(const Check& check) {
  for (const ReferenceRay& ray : test::reference_rays_within()) {
    if (ray.status == LightEnd::sky) {
      check(ray, start_ray(test::station_of(ray), ray.n));
    }
  }
}

template <class Trace>
void expect_reference(double allowed, const Trace& trace) {
  for_each_escaped([&](const ReferenceRay& ray, const RayStart<double>& start) {
    double steps = 0.0;
    bool reached = true;
    const Vector3<double> sky = trace(ray.a, start, steps, reached).sky;
    EXPECT_TRUE(reached) << "ray " << ray.id;
    EXPECT_LT(test::length(sky - ray.sky), allowed) << "ray " << ray.id;
  });
}

TEST(WithinHorizon, LightComesFromTheSkyOrNotAsTheReferenceSays) {
  for (const ReferenceRay& ray : test::reference_rays_within()) {
    const CameraStation camera = test::station_of(ray);
    const bool bright = comes_from_sky(camera.spin, camera.horizon_r, start_ray(camera, ray.n));
    EXPECT_EQ(bright, ray.status == LightEnd::sky) << "ray " << ray.id;
  }
}

TEST(WithinHorizon, LightIsShiftedAsTheReferenceSays) {
  for (const ReferenceRay& ray : test::reference_rays_within()) {
    EXPECT_NEAR(1.0 / start_ray(test::station_of(ray), ray.n).energy / ray.g, 1.0, 1e-13) << "ray " << ray.id;
  }
}

TEST(WithinHorizon, TaylorSeriesSeeTheSkyOfTheReference) {
  expect_reference(1e-12, [](double spin, const RayStart<double>& start, double& steps, bool& reached) {
    return trace_taylor<20>(spin, start, true, {1e-14, 1000}, steps, reached);
  });
}

TEST(WithinHorizon, RungeKuttaPairsSeeTheSkyOfTheReference) {
  expect_reference(1e-9, [](double spin, const RayStart<double>& start, double& steps, bool& reached) {
    return trace_runge_kutta<CashKarp>(spin, start, true, {1e-11, 200'000}, steps, reached);
  });
}

TEST(WithinHorizon, ClosedFormSeesTheSkyOfTheReference) {
  expect_reference(
      3e-13, [](double spin, const RayStart<double>& start, double&, bool&) { return trace_closed_form(spin, start); });
}

TEST(WithinHorizon, ClosedFormTellsItsErrorAtTheHorizonItself) {
  for (const double spin : {0.3, 0.9, 0.998}) {
    for (const double depth : {1e-3, 1e-6, 1e-9}) {
      const CameraStation camera =
          make_camera_station(Spacetime{spin}, horizon_radius(Spacetime{spin}) - depth, 1.2, 0.0, ObserverMotion::rain);
      const RayStart<double> start = start_ray(camera, normalized({0.6, -0.5, 0.4}));
      double steps = 0.0;
      bool reached = false;
      const Vector3<double> sky = trace_taylor<20>(spin, start, true, {1e-14, 1000}, steps, reached).sky;
      const RayEnd<double> exact = trace_closed_form(spin, start);
      EXPECT_LT(test::length(exact.sky - sky), 3e-13 + exact.error_estimate) << spin << ' ' << depth;
    }
  }
}

TEST(WithinHorizon, FloatSeesTheSkyOfTheReferenceToItsRounding) {
  for_each_escaped([](const ReferenceRay& ray, const RayStart<double>&) {
    const CameraStationOf<float> camera = converted_station<float>(test::station_of(ray));
    const Vector3<float> n = {static_cast<float>(ray.n.x), static_cast<float>(ray.n.y), static_cast<float>(ray.n.z)};
    float steps = 0.0F;
    bool reached = false;
    const Vector3<float> sky =
        trace_taylor<8>(camera.spin, start_ray(camera, n), true, {1e-6, 400}, steps, reached).sky;
    EXPECT_TRUE(reached) << "ray " << ray.id;
    const Vector3<double> seen = {static_cast<double>(sky.x), static_cast<double>(sky.y), static_cast<double>(sky.z)};
    EXPECT_LT(test::length(seen - ray.sky), 2e-4) << "ray " << ray.id;
  });
}

//! Traces rays all over the sky in float. Returns an error that 98 of 100 rays do not exceed; 1 if
//! a ray did not converge.
double worst_in_float(double spin, double r) {
  const CameraStation camera = make_camera_station(Spacetime{spin}, r, 1.4, 0.0, ObserverMotion::rain);
  const CameraStationOf<float> coarse = converted_station<float>(camera);
  std::vector<double> errors;
  for (int i = 0; i < 400; ++i) {
    // The directions are on a Fibonacci spiral.
    const double z = 1.0 - (2.0 * i + 1.0) / 400.0;
    const double across = std::sqrt(1.0 - z * z);
    const Vector3<float> n = {static_cast<float>(across * std::cos(2.399963 * i)),
                              static_cast<float>(across * std::sin(2.399963 * i)), static_cast<float>(z)};
    const RayStart<double> start = start_ray(
        camera, Vector3<double>{static_cast<double>(n.x), static_cast<double>(n.y), static_cast<double>(n.z)});
    if (!comes_from_sky(spin, camera.horizon_r, start)) {
      continue;
    }
    double steps = 0.0;
    bool reached = false;
    const Vector3<double> exact = trace_taylor<20>(spin, start, true, {1e-13, 1000, true}, steps, reached).sky;
    float few = 0.0F;
    bool arrived = false;
    const Vector3<float> seen =
        trace_taylor<8>(coarse.spin, start_ray(coarse, n), true, {1e-6, 400, true}, few, arrived).sky;
    const Vector3<double> off = {static_cast<double>(seen.x) - exact.x, static_cast<double>(seen.y) - exact.y,
                                 static_cast<double>(seen.z) - exact.z};
    errors.push_back(arrived ? test::length(off) : 1.0);
  }
  std::ranges::sort(errors);
  return errors[errors.size() * 98 / 100];
}

TEST(WithinHorizon, FloatIsAsGoodNextToTheHorizonOfAnySpin) {
  for (const double spin : {0.0, 0.9, 0.999, -0.9999, 1.0}) {
    for (const double height : {0.1, 0.01, 2e-3, 5e-4, 1e-5}) {
      EXPECT_LT(worst_in_float(spin, horizon_radius(Spacetime{spin}) + height), 2e-4) << spin << ' ' << height;
    }
  }
}

TEST(WithinHorizon, AnglesOfTheBaselineTellNothing) {
  for_each_escaped([](const ReferenceRay& ray, const RayStart<double>& start) {
    double steps = 0.0;
    bool reached = true;
    trace_baseline_rk34(ray.a, start, true, {1e-4, 1000}, steps, reached);
    EXPECT_FALSE(reached) << "ray " << ray.id;
  });
}

TEST(WithinHorizon, RaysFromNextToItDoNotDependOnHowTheirAzimuthIsCounted) {
  for (const double spin : {0.5, -0.9, 0.998}) {
    const double height = 0.2 * (photon_orbit_radius(Spacetime{std::abs(spin)}, 1.0) - horizon_radius(Spacetime{spin}));
    const CameraStation camera =
        make_camera_station(Spacetime{spin}, horizon_radius(Spacetime{spin}) + height, 1.2, 0.0, ObserverMotion::rain);
    RayStart<double> start = start_ray(camera, normalized({0.6, -0.5, 0.4}));
    ASSERT_TRUE(start.ingoing);
    ASSERT_TRUE(comes_from_sky(spin, camera.horizon_r, start));
    double steps = 0.0;
    bool reached = false;
    const Vector3<double> ingoing = trace_taylor<20>(spin, start, true, {1e-14, 1000}, steps, reached).sky;
    start.ingoing = false;
    start.turn = 0.0;
    const Vector3<double> outer = trace_taylor<20>(spin, start, true, {1e-14, 1000}, steps, reached).sky;
    EXPECT_LT(test::length(ingoing - outer), 1e-12) << spin;
  }
}

//! Compares what two observers in free fall, slightly outside and inside the horizon, see in the
//! same direction. The sky of the outer observer is converted to the azimuth of ingoing Kerr
//! coordinates.
TEST(WithinHorizon, NothingHappensToTheSkyAtTheHorizon) {
  constexpr double beside = 1e-7;
  for (const double spin : {0.0, -0.5, 0.9, 0.999}) {
    const Vector3<double> n = normalized({0.7, 0.4, -0.6});
    Vector3<double> seen[2];
    for (int side = 0; side < 2; ++side) {
      const double r = horizon_radius(Spacetime{spin}) + (side == 0 ? -beside : beside);
      const CameraStation camera = make_camera_station(
          Spacetime{spin}, r, 1.1, side == 0 ? 0.0 : -ingoing_turn(Spacetime{spin}, r), ObserverMotion::rain);
      double steps = 0.0;
      bool reached = false;
      seen[side] = turned_to_camera(
          camera, trace_taylor<20>(spin, start_ray(camera, n), true, {1e-14, 1000}, steps, reached).sky);
      EXPECT_TRUE(reached);
    }
    EXPECT_LT(test::length(seen[0] - seen[1]), 30.0 * beside) << spin;
  }
}

//! Returns the angle η between the outward direction and the edge of the shadow, as seen by an
//! observer in free fall around a hole without spin. The light at the edge has the impact parameter
//! b = √27, so r sin η = b E, with E = 1 + v cos η.
double schwarzschild_edge(double r) {
  const double b = std::sqrt(27.0);
  const double v = std::sqrt(2.0 / r);
  return std::atan2(b * v, r) + std::asin(b / std::hypot(r, b * v));
}

TEST(WithinHorizon, ShadowOfAHoleWithoutSpinIsThatOfItsClosedForm) {
  for (const double r : {1.999, 1.5, 1.0, 0.3, 0.05}) {
    const CameraStation camera = make_camera_station(Spacetime{0.0}, r, 1.0, 0.0, ObserverMotion::rain);
    const ShadowChart chart = make_shadow_chart(camera);
    EXPECT_NEAR(chart.centre.x, -1.0, 1e-12) << r;
    EXPECT_NEAR(pi - edge_polar_angle(camera, chart, 0.7), schwarzschild_edge(r), 1e-12) << r;
  }
}

TEST(WithinHorizon, EdgeOfTheShadowIsLightFromACriticalOrbit) {
  for (const double spin : {0.5, -0.9, 0.998}) {
    const double r = inner_horizon_radius(Spacetime{spin}) +
                     0.5 * (horizon_radius(Spacetime{spin}) - inner_horizon_radius(Spacetime{spin}));
    const CameraStation camera = make_camera_station(Spacetime{spin}, r, 1.2, 0.0, ObserverMotion::rain);
    const ShadowChart chart = make_shadow_chart(camera);
    for (int i = 0; i < 16; ++i) {
      const double gamma = pi * (i - 8) / 8.0;
      const double alpha = edge_polar_angle(camera, chart, gamma);
      const RayStart<double> edge = start_ray(camera, chart_direction(chart, std::cos(alpha), std::sin(alpha), gamma));
      EXPECT_NEAR(radial_barrier(spin, camera.horizon_r, edge).clearance, 0.0, 1e-12) << spin << ' ' << gamma;
    }
  }
}

TEST(WithinHorizon, ARainBoostSeesWhatItsVelocityInTheZamoFrameSeesOutside) {
  const Vector3<double> in_rain = {0.3, -0.2, 0.45};
  const double spin = 0.8;
  const double r = 2.5;
  const double theta = 1.1;
  const Vector3<double> in_zamo = observer_velocity(ObserverMotion::rain_boost, Spacetime{spin}, r, theta, in_rain);
  const CameraStation rain = make_camera_station(Spacetime{spin}, r, theta, 0.0, ObserverMotion::rain_boost, in_rain);
  const CameraStation zamo = make_camera_station(Spacetime{spin}, r, theta, 0.0, ObserverMotion::velocity, in_zamo);
  const LorentzTransform turn = rain_axes_from_zamo_axes(Spacetime{spin}, r, theta, in_zamo, in_rain);
  const Vector3<double> n = normalized({0.2, 0.7, -0.5});
  const double in[3] = {n.x, n.y, n.z};
  double out[3] = {};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      out[i] += turn.row[i + 1][j + 1] * in[j];
    }
  }
  const RayStart<double> a = start_ray(zamo, n);
  const RayStart<double> b = start_ray(rain, Vector3<double>{out[0], out[1], out[2]});
  EXPECT_NEAR(turn.row[0][0], 1.0, 1e-12);
  EXPECT_NEAR(a.energy, b.energy, 1e-13);
  EXPECT_NEAR(a.axial_angular_momentum, b.axial_angular_momentum, 1e-12);
  EXPECT_NEAR(a.u_rate, b.u_rate, 1e-13);
  EXPECT_NEAR(a.polar_constant, b.polar_constant, 1e-11);
}

}  // namespace
}  // namespace ergodome
