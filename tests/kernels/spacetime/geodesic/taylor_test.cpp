#include "kernels/spacetime/geodesic/taylor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "kernels/core/angles.h"
#include "kernels/core/dual.h"
#include "kernels/spacetime/geodesic/closed_form.h"
#include "kernels/spacetime/shadow/critical_curve.h"
#include "tests/kernels/reference_tables.h"

namespace ergodome {
namespace {

const IntegrationSettings precise = {1e-14, 1000};

struct Traced {
  bool bright;
  bool reached;
  Vector3<double> sky;
  double mino_time;
};

Traced trace(const CameraStation& camera, const Vector3<double>& n) {
  const RayStart<double> start = start_ray(camera, n);
  const bool bright = comes_from_sky(camera.spin, camera.horizon_r, start);
  double steps = 0.0;
  bool reached = false;
  const RayEnd<double> end = trace_taylor<20>(camera.spin, start, bright, precise, steps, reached);
  return {bright, reached, end.sky, end.mino_time};
}

Vector3<double> unit(double x, double y, double z) { return normalized(Vector3<double>{x, y, z}); }

TEST(Taylor, StatusIsThatOfTheReferenceForEveryRay) {
  for (const auto& ray : test::reference_rays()) {
    EXPECT_EQ(trace(test::station_of(ray), ray.n).bright, ray.status == LightEnd::sky) << "ray " << ray.id;
  }
}

TEST(Taylor, SkyDirectionIsThatOfTheReferenceForEveryRay) {
  for (const auto& ray : test::reference_rays()) {
    if (ray.status == LightEnd::sky) {
      const Traced traced = trace(test::station_of(ray), ray.n);
      EXPECT_TRUE(traced.reached) << "ray " << ray.id;
      EXPECT_LT(test::length(traced.sky - ray.sky), allowed_sky_error(ray)) << "ray " << ray.id << " " << ray.kind;
    }
  }
}

TEST(Taylor, MinoTimeIsThatOfTheReference) {
  for (const auto& ray : test::reference_rays()) {
    if (ray.status == LightEnd::sky && ray.kind == "random") {
      EXPECT_NEAR(trace(test::station_of(ray), ray.n).mino_time, ray.mino_time, 1e-11) << "ray " << ray.id;
    }
  }
}

TEST(Taylor, InFloatTheMedianErrorOfTheRaysAwayFromTheEdgeIsBelowAMillionth) {
  std::vector<double> errors;
  for (const auto& ray : test::reference_rays()) {
    if (ray.status != LightEnd::sky || ray.kind.starts_with("near_edge")) {
      continue;
    }
    const auto camera = converted_station<float>(test::station_of(ray));
    const Vector3<float> n = {static_cast<float>(ray.n.x), static_cast<float>(ray.n.y), static_cast<float>(ray.n.z)};
    const RayStart<float> start = start_ray(camera, n);
    float steps = 0.0F;
    bool reached = false;
    const RayEnd<float> end = trace_taylor<10>(camera.spin, start, true, {1e-7, 1000}, steps, reached);
    errors.push_back(test::length(Vector3<double>{end.sky.x, end.sky.y, end.sky.z} - ray.sky));
  }
  std::nth_element(errors.begin(), errors.begin() + static_cast<long>(errors.size() / 2), errors.end());
  EXPECT_LT(errors[errors.size() / 2], 1e-6);
}

TEST(Taylor, LightBendsByThePublishedAnglesAroundSchwarzschildFromFarAway) {
  // Published total deflection of light with the impact parameter √27 (1 + ε), if source and camera
  // are at infinity. The camera here is at r = 1e7, so that its line of sight is b / r = 5e-7 rad
  // off the radial direction.
  const std::pair<double, double> published[] = {
      {1e-2, 4.22966181183765942}, {1e-4, 8.81048635499560683}, {1e-6, 13.4152855577941784}};
  const double r = 1e7;
  const CameraStation camera = make_camera_station(Spacetime{0.0}, r, pi / 2, 0.0, ObserverMotion::zamo);
  for (const auto& [epsilon, bending] : published) {
    const double sine = std::sqrt(27.0) * (1.0 + epsilon) * std::sqrt(1.0 - 2.0 / r) / r;
    const Traced traced = trace(camera, {-std::sqrt(1.0 - sine * sine), 0.0, sine});
    ASSERT_TRUE(traced.reached);
    // Light without deflection would come from -x. This light passes the hole at positive y and is
    // bent around it.
    const double swept = std::atan2(-traced.sky.y, -traced.sky.x);
    EXPECT_NEAR(std::remainder(swept - bending, 2.0 * pi), 0.0, 2e-6) << "epsilon " << epsilon;
  }
}

TEST(Taylor, LightIsStraightFarFromTheHole) {
  const CameraStation camera = make_camera_station(Spacetime{0.9}, 1e6, 1.0, 0.0, ObserverMotion::zamo);
  const Traced traced = trace(camera, {0.0, 1.0, 0.0});
  const Vector3<double> flat = {std::cos(1.0), 0.0, -std::sin(1.0)};
  EXPECT_LT(test::length(traced.sky - flat), 4e-6);
}

TEST(Taylor, SkyIsMirroredAcrossTheEquator) {
  const Vector3<double> n = unit(-0.4, 0.3, 0.7);
  const Traced north = trace(make_camera_station(Spacetime{0.9}, 6.0, 1.1, 0.0, ObserverMotion::zamo), n);
  const Traced south =
      trace(make_camera_station(Spacetime{0.9}, 6.0, pi - 1.1, 0.0, ObserverMotion::zamo), {n.x, -n.y, n.z});
  EXPECT_LT(test::length(north.sky - Vector3<double>{south.sky.x, south.sky.y, -south.sky.z}), 1e-13);
}

TEST(Taylor, SkyIsMirroredWhenTheSpinIs) {
  const Vector3<double> n = unit(-0.4, 0.3, 0.7);
  const Traced plus = trace(make_camera_station(Spacetime{0.9}, 6.0, 1.1, 0.0, ObserverMotion::zamo), n);
  const Traced minus =
      trace(make_camera_station(Spacetime{-0.9}, 6.0, 1.1, 0.0, ObserverMotion::zamo), {n.x, n.y, -n.z});
  EXPECT_LT(test::length(plus.sky - Vector3<double>{minus.sky.x, -minus.sky.y, minus.sky.z}), 1e-13);
}

TEST(Taylor, GoesContinuouslyToSchwarzschildAsTheSpinGoesToZero) {
  const Vector3<double> n = unit(-0.6, 0.3, 0.7);
  const Traced none = trace(make_camera_station(Spacetime{0.0}, 6.0, 1.1, 0.0, ObserverMotion::zamo), n);
  const Traced tiny = trace(make_camera_station(Spacetime{1e-10}, 6.0, 1.1, 0.0, ObserverMotion::zamo), n);
  EXPECT_LT(test::length(none.sky - tiny.sky), 1e-8);
}

TEST(Taylor, IsSmoothAcrossTheSpinAxis) {
  // The sky direction of a ray that crosses the spin axis (L = 0) must be between those of its
  // neighbors. In polar angles, it would jump by π.
  for (const double theta : {1e-9, 0.3, pi / 2}) {
    const CameraStation camera = make_camera_station(Spacetime{0.9}, 8.0, theta, 0.0, ObserverMotion::zamo);
    const Traced left = trace(camera, unit(-0.2, -0.9, -1e-7));
    const Traced middle = trace(camera, unit(-0.2, -0.9, 0.0));
    const Traced right = trace(camera, unit(-0.2, -0.9, 1e-7));
    EXPECT_LT(test::length(left.sky + right.sky - 2.0 * middle.sky), 1e-11) << theta;
    EXPECT_LT(test::length(left.sky - right.sky), 1e-5) << theta;
  }
}

TEST(Taylor, CameraOnTheAxisSeesWhatACameraBesideItSees) {
  const Vector3<double> n = unit(-0.3, 0.8, 0.5);
  const Traced on = trace(make_camera_station(Spacetime{0.999}, 7.0, 0.0, 0.0, ObserverMotion::zamo), n);
  const Traced beside = trace(make_camera_station(Spacetime{0.999}, 7.0, 1e-9, 0.0, ObserverMotion::zamo), n);
  ASSERT_TRUE(on.reached && beside.reached);
  EXPECT_LT(test::length(on.sky - beside.sky), 1e-7);
}

TEST(Taylor, OutgoingPrincipalNullRayKeepsItsPolarAngle) {
  for (const double a : {0.5, 0.999, 1.0}) {
    const CameraStation camera = make_camera_station(Spacetime{a}, 3.0, 1.0, 0.0, ObserverMotion::zamo);
    const Traced traced = trace(camera, detail::principal_direction(camera, 1.0));
    ASSERT_TRUE(traced.reached);
    EXPECT_NEAR(traced.sky.z, std::cos(1.0), 1e-12) << a;
  }
}

//! Tests distances from the edge of the shadow down to 1e-12 rad, at which double still
//! distinguishes both sides. Directions themselves are rounded at 1e-16.
TEST(Taylor, TellsBothSidesOfTheEdgeApartDownToRounding) {
  for (const double a : {0.0, 0.5, 0.999, 1.0 - 1e-6, 1.0}) {
    for (const double r : {2.5, 5.0, 30.0}) {
      const CameraStation camera = make_camera_station(Spacetime{a}, r, 1.3, 0.0, ObserverMotion::zamo);
      const ShadowChart chart = make_shadow_chart(camera);
      for (const double distance : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
        for (const double gamma : {0.3, 1.7, 3.0, 4.4}) {
          const double edge = edge_polar_angle(camera, chart, gamma);
          for (const double side : {-1.0, 1.0}) {
            const double alpha = edge + side * distance;
            const Traced traced =
                trace(camera, chart_direction<double>(chart, std::cos(alpha), std::sin(alpha), gamma));
            EXPECT_EQ(traced.bright, side > 0.0) << "a " << a << " r " << r << " distance " << side * distance;
            // Along an extremal horizon, light at a distance d from the edge winds 1 / √d times
            // around the hole, otherwise only a few times. If that is too often to count, the
            // status reports it.
            const bool countless = a > 0.99999 && distance < 1e-8;
            EXPECT_TRUE(traced.reached == traced.bright || countless)
                << "a " << a << " r " << r << " distance " << distance;
            if (traced.reached) {
              EXPECT_NEAR(test::length(traced.sky), 1.0, 1e-6);
            }
          }
        }
      }
    }
  }
}

TEST(Taylor, WindsLogarithmicallyTowardsTheEdge) {
  // If the distance from the edge decreases by a factor of 100, the angle around the hole grows by
  // ln 100. In Schwarzschild spacetime, the Lyapunov exponent is 1 per radian.
  const CameraStation camera = make_camera_station(Spacetime{0.0}, 10.0, pi / 2, 0.0, ObserverMotion::zamo);
  const ShadowChart chart = make_shadow_chart(camera);
  const double edge = edge_polar_angle(camera, chart, 0.0);
  const auto swept = [&](double distance) {
    const Vector3<double> n = chart_direction<double>(chart, std::cos(edge + distance), std::sin(edge + distance), 0.0);
    return std::sqrt(start_ray(camera, n).polar_constant) * trace(camera, n).mino_time;
  };
  EXPECT_NEAR(swept(1e-8) - swept(1e-6), std::log(100.0), 1e-4);
  EXPECT_NEAR(swept(1e-10) - swept(1e-8), std::log(100.0), 1e-4);
}

TEST(Taylor, MeetsItsToleranceWhereTheLastTermsOfTheSeriesVanish) {
  // The camera is at r = 6 without spin, and the light is at its turning point. There u - 1/6
  // contains only the powers 2, 6, 10, 14, 18 and 22 of Mino time.
  const CameraStation camera = make_camera_station(Spacetime{0.0}, 6.0, 1.0, 0.0, ObserverMotion::zamo);
  for (const double inwards : {0.0, 1e-9, 1e-4, 1e-3, -1e-3, 1e-2}) {
    const RayStart<double> start = start_ray(camera, unit(-inwards, 0.6, 0.8));
    double steps = 0.0;
    bool reached = false;
    const RayEnd<double> end = trace_taylor<20>(0.0, start, true, {1e-12, 1000}, steps, reached);
    ASSERT_TRUE(reached);
    EXPECT_LT(test::length(end.sky - trace_closed_form(0.0, start).sky), 1e-11) << inwards;
  }
}

//! Returns by how much a ray's sky direction changes if the observed direction is rounded
//! differently [rad]; 10 if the ray becomes dark.
double moved_by_rounding(const CameraStation& camera, const Vector3<double>& n, const Vector3<double>& sky) {
  constexpr double ulps = 4.0 * std::numeric_limits<double>::epsilon();
  double moved = 0.0;
  for (const Vector3<double>& other :
       {Vector3<double>{n.x * (1.0 - ulps), n.y, n.z}, Vector3<double>{n.x, n.y * (1.0 + ulps), n.z},
        Vector3<double>{n.x, n.y, n.z * (1.0 + ulps)}}) {
    const Traced neighbour = trace(camera, other);
    moved = std::max(moved, neighbour.reached ? test::length(neighbour.sky - sky) : 10.0);
  }
  return moved;
}

//! Compares closed form and Taylor series for rays at a distance outside the edge of the shadow.
//! Skips rays whose sky direction depends too strongly on rounding. Returns the number of rays that
//! were compared.
int compare_beside_edge(const CameraStation& camera, double distance) {
  const ShadowChart chart = make_shadow_chart(camera);
  int compared = 0;
  for (int i = 0; i < 40; ++i) {
    const double gamma = 2.0 * pi * (i + 0.3) / 40.0;
    const double alpha = edge_polar_angle(camera, chart, gamma) + distance;
    const Vector3<double> n = chart_direction<double>(chart, std::cos(alpha), std::sin(alpha), gamma);
    const Traced series = trace(camera, n);
    const double allowed = 1e-10 + 1e-13 / distance;
    const double moved = moved_by_rounding(camera, n, series.sky);
    if (!series.reached || moved > 0.3 * allowed) {
      continue;
    }
    const RayEnd<double> closed = trace_closed_form(camera.spin, start_ray(camera, n));
    // Each method rounds the constants of motion several times, so the effect of one rounding is
    // multiplied by 4.
    EXPECT_LT(test::length(series.sky - closed.sky), allowed + 4.0 * moved)
        << camera.spin << " " << 1.0 / camera.u << " " << distance << " " << gamma;
    ++compared;
  }
  return compared;
}

TEST(ClosedForm, KeepsItsDigitsWhereTheHorizonsMeet) {
  for (const double spin : {1.0, -1.0, 1.0 - 1e-13, 1.0 - 1e-10, -1.0 + 1e-7}) {
    int compared = 0;
    for (const double r : {1.5, 2.0, 3.0, 6.0}) {
      for (const double theta : {0.3, 1.0, 1.57}) {
        const CameraStation camera = make_camera_station(Spacetime{spin}, r, theta, 0.0, ObserverMotion::zamo);
        compared += compare_beside_edge(camera, 1e-2) + compare_beside_edge(camera, 1e-4);
      }
    }
    EXPECT_GT(compared, 700) << spin;
  }
}

TEST(Taylor, CountsARayThatRunsOutOfStepsAsNotConverged) {
  const CameraStation camera = make_camera_station(Spacetime{0.9}, 10.0, 1.0, 0.0, ObserverMotion::zamo);
  double steps = 0.0;
  bool reached = true;
  trace_taylor<20>(camera.spin, start_ray(camera, unit(-0.7, 0.7, 0.2)), true, {1e-14, 2}, steps, reached);
  EXPECT_FALSE(reached);
  EXPECT_EQ(steps, 2.0);
}

TEST(Taylor, LightWithoutPositiveEnergyInTheErgosphereIsDark) {
  const CameraStation camera = make_camera_station(Spacetime{0.999}, 1.3, pi / 2, 0.0, ObserverMotion::zamo);
  // Light from this side, which the rotation of the hole moves away from, would have negative
  // energy.
  const RayStart<double> ray = start_ray(camera, unit(0.05, 0.0, 1.0));
  ASSERT_LT(ray.energy, 0.0);
  EXPECT_FALSE(comes_from_sky(camera.spin, camera.horizon_r, ray));
}

TEST(Taylor, MagnificationFromExactDerivativesIsThatOfTheReference) {
  int compared = 0;
  for (const auto& ray : test::reference_rays()) {
    if (ray.status != LightEnd::sky || ray.magnification == 0.0) {
      continue;
    }
    const CameraStation camera = test::station_of(ray);
    const Vector3<double> axis =
        std::abs(ray.n.z) < 0.7 ? Vector3<double>{0.0, 0.0, 1.0} : Vector3<double>{0.0, 1.0, 0.0};
    const Vector3<double> e1 = normalized(cross(axis, ray.n));
    const Vector3<double> e2 = cross(ray.n, e1);
    const Vector3<Dual<double>> n = {{ray.n.x, e1.x, e2.x}, {ray.n.y, e1.y, e2.y}, {ray.n.z, e1.z, e2.z}};
    double steps = 0.0;
    bool reached = false;
    const auto end = trace_taylor<20>(camera.spin, start_ray(camera, n), true, precise, steps, reached);
    const Vector3<double> dx = {end.sky.x.along_x, end.sky.y.along_x, end.sky.z.along_x};
    const Vector3<double> dy = {end.sky.x.along_y, end.sky.y.along_y, end.sky.z.along_y};
    // Within 1e-3 rad of the edge, the table's derivatives, which are finite differences, lose
    // their digits. The derivatives of this test agree there to 1e-10 between orders, tolerances
    // and bases.
    const double allowed = std::abs(ray.edge_distance) > 1e-3 ? 1e-7 : 2e-5;
    const double magnification = 1.0 / test::length(cross(dx, dy));
    EXPECT_NEAR(magnification, std::abs(ray.magnification), allowed * std::abs(ray.magnification)) << "ray " << ray.id;
    ++compared;
  }
  EXPECT_GT(compared, 100);
}

TEST(Taylor, DerivativesAreThoseOfDifferenceQuotients) {
  const CameraStation camera = make_camera_station(Spacetime{0.999}, 5.0, 1.2, 0.0, ObserverMotion::geodesic);
  const Vector3<double> n = unit(-0.2, 0.7, 0.7);
  const Vector3<double> e = normalized(cross(Vector3<double>{0.0, 0.0, 1.0}, n));
  const Vector3<Dual<double>> dual = {{n.x, e.x, 0.0}, {n.y, e.y, 0.0}, {n.z, e.z, 0.0}};
  double steps = 0.0;
  bool reached = false;
  const auto end = trace_taylor<20>(camera.spin, start_ray(camera, dual), true, precise, steps, reached);
  const double h = 1e-5;
  const Vector3<double> difference =
      (0.5 / h) * (trace(camera, normalized(n + h * e)).sky - trace(camera, normalized(n - h * e)).sky);
  const Vector3<double> derivative = {end.sky.x.along_x, end.sky.y.along_x, end.sky.z.along_x};
  EXPECT_LT(test::length(derivative - difference), 1e-8 * (1.0 + test::length(difference)));
}

}  // namespace
}  // namespace ergodome
