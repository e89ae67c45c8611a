#include "kernels/spacetime/schwarzschild/ray_curve.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kernels/core/angles.h"

namespace ergodome {
namespace {

//! Follows a ray in steps from `position`, at the observer or at the point, to the fraction
//! `to_share` of its path.
RayPosition followed(RayPosition position, double angle, double to_share) {
  const int steps = static_cast<int>(std::ceil(std::abs(to_share - position.share) / longest_ray_step(angle)));
  const double step = (to_share - position.share) / std::max(steps, 1);
  for (int i = 0; i < steps; ++i) {
    position = moved_on(position, angle, step);
  }
  return position;
}

struct Pair {
  double r_observer, r, angle;
};

//! Rays that are direct, have a turning point, fall in, or wind around the hole, at small and large
//! radii.
constexpr Pair ray_pairs[] = {{40.0, 6.0, 1.0},      {40.0, 6.0, 3.0}, {40.0, 6.0, 1.7 * pi}, {40.0, 2.2, 2.4},
                              {2.5, 30.0, 2.0},      {2.2, 2.7, 0.4},  {1e5, 12.0, 3.1},      {40.0, 16.0, 2.6 * pi},
                              {40.0, 6.0, 4.3 * pi}, {7.0, 7.0, 0.7},  {40.0, 39.0, 1e-3},    {40.0, 3.0, 2.0}};

TEST(RayCurve, BothHalvesMeetInTheMiddle) {
  for (const auto& [r_observer, r, angle] : ray_pairs) {
    const ConnectingRay ray = connecting_ray(r_observer, r, angle);
    const RayPosition one = followed(position_at_observer(ray, r_observer, r, angle), angle, 0.5);
    const RayPosition other = followed(position_at_point(ray, r_observer, r, angle), angle, 0.5);
    EXPECT_NEAR(one.u, other.u, 1e-11 * one.u) << r_observer << " " << r << " " << angle;
    EXPECT_NEAR(one.u_rate, other.u_rate, 1e-10 * angle) << r_observer << " " << r << " " << angle;
  }
}

TEST(RayCurve, TheWholeWayKeepsTheImpactParameter) {
  for (const auto& [r_observer, r, angle] : ray_pairs) {
    const ConnectingRay ray = connecting_ray(r_observer, r, angle);
    const double inverse_b = 1.0 / ray.impact_parameter;
    for (const double share : {0.1, 0.3, 0.5}) {
      for (const RayPosition& end :
           {position_at_observer(ray, r_observer, r, angle), position_at_point(ray, r_observer, r, angle)}) {
        const RayPosition at = followed(end, angle, end.share > 0.5 ? 1.0 - share : share);
        const double rate = at.u_rate / angle;
        const double expected = inverse_b * inverse_b - at.u * at.u + 2.0 * at.u * at.u * at.u;
        EXPECT_NEAR(rate * rate, expected, 1e-12 + 1e-10 * expected) << r_observer << " " << r << " " << angle;
      }
    }
  }
}

TEST(RayCurve, AzimuthBetweenPlacesIsTheEllipticIntegral) {
  // The light moves inwards from r = 40 M to 2.2 M, on an orbit without a turning point.
  const double angle = 2.4;
  const ConnectingRay ray = connecting_ray(40.0, 2.2, angle);
  ASSERT_LT(ray.impact_parameter, std::sqrt(27.0));
  // Finds the orbit by Newton's method: 1/b² = g² (1 + 2 g) with g = 1/6 + excess.
  double g = 0.3;
  for (int i = 0; i < 50; ++i) {
    const double inverse_b = 1.0 / ray.impact_parameter;
    g -= (g * g * (1.0 + 2.0 * g) - inverse_b * inverse_b) / (2.0 * g + 6.0 * g * g);
  }
  const PlungingOrbit orbit = plunging_orbit(g - 1.0 / 6.0);
  const RayPosition start = position_at_observer(ray, 40.0, 2.2, angle);
  for (const double share : {0.2, 0.4, 0.6, 0.8}) {
    const RayPosition at = followed(start, angle, share);
    EXPECT_NEAR(swept_angle(orbit, start.u - 1.0 / 3.0, at.u - 1.0 / 3.0, at.u - start.u), share * angle, 1e-10);
  }
}

TEST(RayCurve, RadialRaysRunEvenlyInInverseRadius) {
  const ConnectingRay ray = connecting_ray(40.0, 8.0, 0.0);
  const RayPosition at = followed(position_at_observer(ray, 40.0, 8.0, 0.0), 0.0, 0.25);
  EXPECT_NEAR(at.u, 1.0 / 40.0 + 0.25 * (1.0 / 8.0 - 1.0 / 40.0), 1e-15);
}

}  // namespace
}  // namespace ergodome
