#include "kernels/core/angles.h"
#include "tests/hard_cases/ray_sets.h"

// The list of hard cases. The columns of allowed errors are those of struct Allowed: rays in double
// [rad on the sky]; rays in float [rad on the screen]; live grid, streamed stations and published
// quadtree [px of a 4096² dome].
namespace ergodome::test {

namespace {

using enum ObserverMotion;

constexpr double r_plus = 1.435889894354067;  // horizon of a = 0.9

//! The usual limits. Rays in double: ten times the requested tolerance. Rays in float: a few
//! roundings. Live grid, for 99 of 100 rays: the budget of 0.1 px and a fifth more for random
//! sampling. Streamed stations: half as much again as the budget.
constexpr Allowed usual = {1e-11, 2e-6, 0.12, 0.15, 0.2};
const char* const as_anywhere = "nothing is harder here than elsewhere";

//! Limits for rays very close to the edge of the shadow: float only resolves whether such a ray is
//! dark, and the quadtree has holes there.
constexpr Allowed at_edge = {1e-11, side_alone, 0.12, 0.15, unbounded};
const char* const float_side =
    "float rounds the direction by 6e-8 rad, a part of the distance that the winding sky magnifies; the quadtree "
    "has holes where cells straddle the edge";

//! Limits for rays whose distance from the edge of the shadow float does not resolve.
constexpr Allowed beyond_float = {1e-11, unbounded, 0.12, 0.15, unbounded};
const char* const no_float =
    "nearer than float tells directions: rays in float may say that they do not converge, or take the other side; "
    "grids keep the edge from double";

//! Limits for cameras inside the horizon, down to the smallest radius of cameras. Streamed stations
//! and the quadtree are tested only outside the horizon.
constexpr Allowed within = {1e-10, 5e-5, 0.12, not_asked, not_asked};
constexpr Allowed deep_within = {2e-8, 2e-4, 0.12, not_asked, not_asked};
const char* const more_caustics =
    "light comes out past the orbits of light, where errors grow by one over the distance from the edge; and a "
    "hundredth of the sky lies so near to "
    "caustics that the map's smaller singular value is below 0.1: on the screen errors grow by one over that";

}  // namespace

const std::vector<HardCase>& hard_cases() {
  static const std::vector<HardCase> all = {
      {"SpinZero", {0.0, 6.0, 1.0}, whole_sky, usual, as_anywhere},
      {"SpinTiny", {1e-9, 6.0, 1.0}, whole_sky, usual, as_anywhere},
      {"SpinOne", {1.0, 6.0, 1.0}, whole_sky, usual, as_anywhere},
      {"SpinMinusOne", {-1.0, 6.0, 1.0}, whole_sky, usual, as_anywhere},
      {"SpinAMillionthBelowOne", {1.0 - 1e-6, 6.0, 1.0}, whole_sky, usual, as_anywhere},

      {"OnTheAxis", {0.9, 6.0, 0.0}, whole_sky, usual, as_anywhere},
      {"OnTheSouthernAxis", {0.9, 6.0, pi}, whole_sky, usual, as_anywhere},
      {"BesideTheAxis", {0.9, 6.0, 1e-9}, whole_sky, usual, as_anywhere},
      {"OnTheAxisOfAnExtremalHole", {1.0, 3.0, 0.0}, whole_sky, usual, as_anywhere},
      {"RaysThroughTheAxis", {0.9, 6.0, 1.0}, without_angular_momentum, usual, as_anywhere},
      {"RaysThroughTheAxisFromTheEquator",
       {0.999, 4.0, 0.5 * pi, geodesic},
       without_angular_momentum,
       usual,
       as_anywhere},

      {"PrincipalRays",
       {0.9, 6.0, 0.7},
       about_principal_rays,
       {2e-8, 2e-6, 0.12, 0.15, 0.2},
       "the reference loses half of its digits where both turning points in θ meet; rays at two orders agree to 1e-16"},
      {"PrincipalRaysOfAnExtremalHole",
       {1.0, 2.5, 0.5 * pi, rain},
       about_principal_rays,
       {4e-9, 2e-6, 0.12, 0.15, 0.2},
       "as other principal rays"},
      {"AlongTheCamerasAxes", {0.9, 6.0, 0.5 * pi}, along_axes, usual, as_anywhere},
      {"AlongTheCamerasAxesWithoutSpin", {0.0, 6.0, 1.0}, along_axes, usual, as_anywhere},

      {"EdgeWithin1e2",
       {0.9, 8.0, 1.3},
       beside_edge_1e<2>,
       {1e-11, 5e-6, 0.2, 0.3, unbounded},
       "all rays are where the sky is stretched 300 times: no easy ones hide the worst; the quadtree's cells straddle "
       "the edge"},
      {"EdgeWithin1e4", {0.9, 8.0, 1.3}, beside_edge_1e<4>, at_edge, float_side},
      {"EdgeWithin1e6", {0.9, 8.0, 1.3}, beside_edge_1e<6>, at_edge, float_side},
      {"EdgeWithin1e8", {0.9, 8.0, 1.3}, beside_edge_1e<8>, beyond_float, no_float},
      {"EdgeWithin1e10", {0.9, 8.0, 1.3}, beside_edge_1e<10>, beyond_float, no_float},
      {"EdgeWithin1e12", {0.9, 8.0, 1.3}, beside_edge_1e<12>, beyond_float, no_float},
      {"EdgeOfSchwarzschildWithin1e10", {0.0, 8.0, 1.3}, beside_edge_1e<10>, beyond_float, no_float},
      {"EdgeOfAnExtremalHoleWithin1e4",
       {1.0, 8.0, 0.5 * pi},
       beside_edge_1e<4>,
       {side_alone, unbounded, 0.12, 0.15, unbounded},
       "on the straight side light grazes the horizon, where the reference ends and space turns without end"},
      {"EdgeOfAnExtremalHoleWithin1e10",
       {1.0, 8.0, 0.5 * pi},
       beside_edge_1e<10>,
       {unbounded, unbounded, unbounded, unbounded, unbounded},
       "along an extremal horizon light winds 1 / √distance times: too often to count, and said so"},

      {"AtTheHorizon",
       {0.9, r_plus + 1e-6, 1.2, rain},
       whole_sky,
       {5e-9, 2e-5, 0.12, 0.15, 0.2},
       "the reference takes two numbers from each other that have no end at the horizon; rays count azimuths as what "
       "falls in does, and do not "
       "feel it"},
      {"AtTheHorizonOfSchwarzschild", {0.0, 2.0 + 1e-6, 1.2, rain}, whole_sky, usual, as_anywhere},
      {"AtTheHorizonOfAnExtremalHole",
       {1.0, 1.0 + 1e-6, 1.2, rain},
       whole_sky,
       {unbounded, unbounded, not_asked, not_asked, not_asked},
       "space is dragged round a million times; tests ShellCrossings hold what can be held "
       "there"},
      {"JustWithinTheHorizon",
       {0.9, r_plus - 1e-6, 1.2, rain},
       whole_sky,
       {5e-9, 2e-5, 0.12, not_asked, not_asked},
       "the closed form takes two numbers from each other that have no end at the horizon; beside caustics as within "
       "it"},
      {"WithinTheHorizon", {0.9, 1.0, 1.2, rain_boost, {0.1, -0.2, 0.3}}, whole_sky, within, more_caustics},
      {"OnTheAxisWithinTheHorizon", {0.9, 1.0, 0.0, rain}, whole_sky, within, more_caustics},
      {"AboveTheInnerHorizon", {0.9, 0.5816, 1.2, rain}, whole_sky, deep_within, more_caustics},
      {"AboveTheSingularity", {0.0, 0.04, 1.2, rain}, whole_sky, deep_within, more_caustics},
      {"InTheErgosphere",
       {0.999, 1.5, 0.5 * pi},
       whole_sky,
       {1e-11, 2e-5, 0.12, 0.3, 0.2},
       "the sky is stretched 6,000 times along the prograde edge"},
      {"FallingThroughTheErgosphere",
       {0.999, 1.5, 1.2, rain},
       whole_sky,
       {1e-11, 4e-6, 0.12, 0.15, 0.2},
       "free fall at 0.99 c sees directions spread, and errors of the third-order pair with them"},
      {"AtThePhotonOrbit",
       {0.0, 3.0, 0.5 * pi},
       whole_sky,
       {1e-11, 2e-6, 0.12, 0.15, not_asked},
       "the shadow's edge is a great circle through the quadtree's vertices, whose rays never end"},

      {"FarAway", {0.9, 1e6, 1.0}, whole_sky, usual, as_anywhere},
      {"FarAwayAtTheEdge", {0.9, 1e6, 1.0}, beside_edge_1e<8>, beyond_float, no_float},
      {"LightPathsOfTenThousandM", {0.9, 1e4, 1.0}, beside_edge_1e<6>, at_edge, float_side},

      {"NearlyAsFastAsLight",
       {0.9, 8.0, 0.5 * pi, velocity, {0.0, 0.0, 0.9999}},
       whole_sky,
       {1e-11, 2e-4, 0.5, 1.2, 0.2},
       "aberration spreads 0.014 rad of the rain frame, where grids are in float, over all of the screen: 141 times "
       "its rounding"},
      {"TowardsThePolesOfTheSky", {0.9, 6.0, 1.0}, towards_sky_poles, usual, as_anywhere},
      {"TowardsTheSeamOfTheSky", {0.9, 6.0, 1.0}, towards_sky_seam, usual, as_anywhere},
      {"ZenithAndRimOfADome", {0.999, 5.0, 0.5 * pi, geodesic}, dome_zenith_and_rim, usual, as_anywhere},
  };
  return all;
}

}  // namespace ergodome::test
