#include <gtest/gtest.h>

#include <cmath>

#include "kernels/core/angles.h"
#include "kernels/spacetime/geodesic/baseline_rk34.h"
#include "kernels/spacetime/geodesic/closed_form.h"
#include "kernels/spacetime/geodesic/runge_kutta.h"
#include "kernels/spacetime/geodesic/taylor.h"
#include "kernels/spacetime/shadow/critical_curve.h"
#include "tests/kernels/reference_tables.h"
#include "tests/support/sanitized.h"

namespace ergodome {
namespace {

struct Outcome {
  Vector3<double> sky;
  double steps;
  bool reached;
};

Outcome by_taylor(const CameraStation& camera, const Vector3<double>& n) {
  Outcome o{};
  o.sky = trace_taylor<20>(camera.spin, start_ray(camera, n), true, {1e-14, 1000}, o.steps, o.reached).sky;
  return o;
}

template <class Tableau>
Outcome by_pair(const CameraStation& camera, const Vector3<double>& n, double tolerance) {
  Outcome o{};
  o.sky =
      trace_runge_kutta<Tableau>(camera.spin, start_ray(camera, n), true, {tolerance, 200'000}, o.steps, o.reached).sky;
  return o;
}

Outcome by_baseline(const CameraStation& camera, const Vector3<double>& n, double tolerance) {
  Outcome o{};
  o.sky = trace_baseline_rk34(camera.spin, start_ray(camera, n), true, {tolerance, 20'000}, o.steps, o.reached).sky;
  return o;
}

Outcome by_closed_form(const CameraStation& camera, const Vector3<double>& n) {
  return {trace_closed_form(camera.spin, start_ray(camera, n)).sky, 1.0, true};
}

TEST(ClosedForm, SkyDirectionIsThatOfTheReferenceForEveryRay) {
  for (const auto& ray : test::reference_rays()) {
    if (ray.status == LightEnd::sky) {
      const Outcome o = by_closed_form(test::station_of(ray), ray.n);
      EXPECT_LT(test::length(o.sky - ray.sky), allowed_sky_error(ray)) << "ray " << ray.id << " " << ray.kind;
    }
  }
}

TEST(ClosedForm, MinoTimeIsThatOfTheReference) {
  for (const auto& ray : test::reference_rays()) {
    if (ray.status == LightEnd::sky && ray.kind == "random") {
      const double time = trace_closed_form(ray.a, start_ray(test::station_of(ray), ray.n)).mino_time;
      EXPECT_NEAR(time, ray.mino_time, 1e-11) << "ray " << ray.id;
    }
  }
}

TEST(ClosedForm, FindsTheRootsOfRaysWhoseResolventBendsAboveItsOnlyRoot) {
  // Light that moves with the frame dragging, seen in free fall through the ergosphere, with small
  // K / C. For such rays, Newton's method that starts above the root did not find the root.
  const CameraStation camera = make_camera_station(Spacetime{0.999}, 1.5, 1.2, 0.0, ObserverMotion::rain);
  for (const Vector3<double>& n :
       {Vector3<double>{-0.55206, -0.16763, -0.81678}, Vector3<double>{-0.41016, 0.15865, -0.89811},
        Vector3<double>{-0.36781, 0.06948, -0.9273}}) {
    const Outcome series = by_taylor(camera, normalized(n));
    ASSERT_TRUE(series.reached);
    EXPECT_LT(test::length(series.sky - by_closed_form(camera, normalized(n)).sky), 1e-11);
  }
}

//! A camera and a direction that the reference table does not contain. Closed form and Taylor
//! series, two independent methods, must agree for them.
struct HardCase {
  const char* name;
  double spin, r, theta;
  Vector3<double> n;
  double tolerance;
};

class HardCases : public testing::TestWithParam<HardCase> {};

TEST_P(HardCases, ClosedFormAndTaylorSeriesAgree) {
  const HardCase& c = GetParam();
  const CameraStation camera = make_camera_station(Spacetime{c.spin}, c.r, c.theta, 0.0, ObserverMotion::zamo);
  const Vector3<double> n = normalized(c.n);
  ASSERT_TRUE(direction_is_bright(camera, n));
  const Outcome series = by_taylor(camera, n);
  ASSERT_TRUE(series.reached);
  EXPECT_LT(test::length(series.sky - by_closed_form(camera, n).sky), c.tolerance);
}

INSTANTIATE_TEST_SUITE_P(
    Kerr, HardCases,
    testing::Values(HardCase{"Schwarzschild", 0.0, 6.0, 1.0, {-0.5, 0.4, 0.8}, 1e-12},
                    HardCase{"TinySpin", 1e-8, 6.0, 1.0, {-0.5, 0.4, 0.8}, 1e-12},
                    HardCase{"ExtremalSpin", 1.0, 6.0, 1.0, {-0.5, 0.4, 0.8}, 1e-9},
                    HardCase{"ExtremalSpinAgainst", -1.0, 6.0, 1.0, {-0.5, 0.4, 0.8}, 1e-9},
                    HardCase{"AlmostExtremalSpin", 1.0 - 1e-6, 6.0, 1.0, {-0.5, 0.4, 0.8}, 1e-11},
                    HardCase{"OnTheAxis", 0.9, 6.0, 0.0, {-0.3, 0.4, 0.8}, 1e-11},
                    HardCase{"OnTheSouthernAxis", 0.9, 6.0, pi, {-0.3, 0.4, 0.8}, 1e-11},
                    HardCase{"BesideTheAxis", 0.9, 6.0, 1e-9, {-0.3, 0.4, 0.8}, 1e-10},
                    HardCase{"ThroughTheAxis", 0.9, 6.0, 1.0, {-0.3, -0.9, 0.0}, 1e-10},
                    HardCase{"InTheEquator", 0.9, 6.0, pi / 2, {-0.3, 0.0, 0.9}, 1e-11},
                    HardCase{"StraightOutInTheEquator", 0.9, 6.0, pi / 2, {1.0, 0.0, 0.0}, 1e-12},
                    HardCase{"BesideStraightOutInTheEquator", 0.9, 6.0, pi / 2, {1.0, 1e-9, 2e-9}, 1e-12},
                    HardCase{"HardlyOutOfTheEquator", 0.9, 6.0, pi / 2, {0.3, 1e-10, 0.9}, 1e-12},
                    HardCase{"AtItsTurningPoint", 0.9, 6.0, pi / 2, {1e-9, 1.0, 0.1}, 1e-12},
                    HardCase{"JustBeforeItsTurningPoint", 0.9, 6.0, 1.0, {-1e-7, 0.6, 0.8}, 1e-12},
                    HardCase{"StraightOutWithoutSpin", 0.0, 6.0, 1.0, {1.0, 0.0, 0.0}, 1e-12},
                    HardCase{"StraightOut", 0.9, 6.0, 0.7, {1.0, 0.0, 0.0}, 1e-12},
                    HardCase{"NearlyStraightOut", 0.999, 3.0, 0.3, {1.0, 0.05, -0.02}, 1e-11},
                    HardCase{"JustOutsideTheHorizon", 0.9, 1.435890943540674 + 1e-6, 1.2, {1.0, 1e-5, 0.0}, 1e-7},
                    HardCase{"InTheErgosphere", 0.999, 1.6, pi / 2, {0.9, 0.1, -0.2}, 1e-10},
                    HardCase{"FarAway", 0.9, 1e6, 1.0, {-0.5, 0.4, 0.8}, 1e-11},
                    HardCase{"FarAwayAndClosePast", 0.9, 1e6, 1.0, {-1.0, 9e-6, 0.0}, 1e-9}),
    [](const auto& each) { return std::string(each.param.name); });

TEST(HardCasesAtTheEdge, ClosedFormAndTaylorSeriesAgreeDownToTheRoundingOfTheDirection) {
  for (const double a : {0.0, 0.5, 0.999}) {
    const CameraStation camera = make_camera_station(Spacetime{a}, 8.0, 1.3, 0.0, ObserverMotion::zamo);
    const ShadowChart chart = make_shadow_chart(camera);
    for (const double distance : {1e-2, 1e-4, 1e-6, 1e-8}) {
      for (const double gamma : {0.3, 1.7, 4.4}) {
        const double alpha = edge_polar_angle(camera, chart, gamma) + distance;
        const Vector3<double> n = chart_direction<double>(chart, std::cos(alpha), std::sin(alpha), gamma);
        const Outcome series = by_taylor(camera, n);
        ASSERT_TRUE(series.reached);
        // Both methods use the same rounded direction, but round the constants of motion
        // differently. This causes an error of 1e-13 rad² / distance.
        EXPECT_LT(test::length(series.sky - by_closed_form(camera, n).sky), 1e-10 + 2e-13 / distance)
            << a << " " << distance;
      }
    }
  }
}

template <class Tableau>
void expect_tolerance_met(double tolerance) {
  for (const auto& ray : test::reference_rays()) {
    const bool is_asked = !test::sanitized || ray.id % 4 == 0;
    if (is_asked && ray.status == LightEnd::sky) {
      const Outcome o = by_pair<Tableau>(test::station_of(ray), ray.n, tolerance);
      ASSERT_TRUE(o.reached) << "ray " << ray.id;
      EXPECT_LT(test::length(o.sky - ray.sky), 10.0 * tolerance + 1e-13 / std::abs(ray.edge_distance))
          << "ray " << ray.id;
    }
  }
}

TEST(RungeKutta34, MeetsTheToleranceWithinAFactorTenOnEveryReferenceRay) {
  for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
    expect_tolerance_met<RungeKutta34>(tolerance);
  }
}

TEST(CashKarp, MeetsTheToleranceWithinAFactorTenOnEveryReferenceRay) {
  for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
    expect_tolerance_met<CashKarp>(tolerance);
  }
}

TEST(CashKarp, NeedsFewerStepsThanTheThirdOrderPair) {
  const CameraStation camera = make_camera_station(Spacetime{0.9}, 6.0, 1.0, 0.0, ObserverMotion::zamo);
  const Vector3<double> n = normalized(Vector3<double>{-0.5, 0.4, 0.8});
  EXPECT_LT(2.0 * by_pair<CashKarp>(camera, n, 1e-9).steps, by_pair<RungeKutta34>(camera, n, 1e-9).steps);
}

template <class Tableau>
void expect_order_conditions(double fifth_moment_order) {
  double sum = 0.0;
  double embedded_sum = 0.0;
  double moment[5] = {0.0, 0.0, 0.0, 0.0, 0.0};
  for (int i = 0; i < Tableau::stages; ++i) {
    double c = 0.0;
    for (int j = 0; j < i; ++j) {
      c += Tableau::a(i, j);
    }
    sum += Tableau::b(i);
    embedded_sum += Tableau::b_embedded(i);
    for (int k = 1; k < 5; ++k) {
      moment[k] += Tableau::b(i) * std::pow(c, k);
    }
  }
  EXPECT_NEAR(sum, 1.0, 1e-15);
  EXPECT_NEAR(embedded_sum, 1.0, 1e-15);
  for (int k = 1; k < fifth_moment_order; ++k) {
    EXPECT_NEAR(moment[k], 1.0 / (k + 1), 1e-14) << k;
  }
}

TEST(Tableau, WeightsFulfilTheQuadratureConditionsOfTheirOrder) {
  expect_order_conditions<RungeKutta34>(4);
  expect_order_conditions<CashKarp>(5);
}

TEST(Baseline, AgreesWithTheOthersAwayFromThePoles) {
  for (const double a : {0.0, 0.9}) {
    const CameraStation camera = make_camera_station(Spacetime{a}, 8.0, pi / 2, 0.0, ObserverMotion::zamo);
    for (const Vector3<double>& n : {Vector3<double>{-0.5, 0.1, 0.8}, Vector3<double>{0.3, -0.2, -0.9}}) {
      const Outcome baseline = by_baseline(camera, normalized(n), 1e-7);
      ASSERT_TRUE(baseline.reached);
      EXPECT_LT(test::length(baseline.sky - by_taylor(camera, normalized(n)).sky), 1e-5);
    }
  }
}

//! Demonstrates the failure of the published tracer for rays that pass the spin axis, where its
//! polar angles are singular. The unit vectors of our methods are not.
TEST(Baseline, FailsOrStallsAtThePolesWhereTheOthersDoNot) {
  constexpr double tolerance = 1e-6;
  int rays = 0;
  int defeated = 0;
  for (const auto& ray : test::reference_rays()) {
    if (ray.status != LightEnd::sky || ray.theta > 0.01) {
      continue;
    }
    ++rays;
    const CameraStation camera = test::station_of(ray);
    const double allowed = 10.0 * tolerance + 1e-13 / std::abs(ray.edge_distance);
    const Outcome cash_karp = by_pair<CashKarp>(camera, ray.n, tolerance);
    EXPECT_TRUE(cash_karp.reached && test::length(cash_karp.sky - ray.sky) < allowed) << "ray " << ray.id;
    EXPECT_LT(test::length(by_taylor(camera, ray.n).sky - ray.sky), allowed) << "ray " << ray.id;
    const Outcome baseline = by_baseline(camera, ray.n, tolerance);
    const bool fails = !baseline.reached || test::length(baseline.sky - ray.sky) > 100.0 * allowed;
    const bool stalls = baseline.steps > 100.0 * cash_karp.steps;
    defeated += fails || stalls ? 1 : 0;
  }
  EXPECT_GT(rays, 50);
  EXPECT_GT(defeated, 2 * rays / 5) << "of " << rays;
}

}  // namespace
}  // namespace ergodome
