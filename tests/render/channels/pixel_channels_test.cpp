#include "render/channels/pixel_channels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "kernels/core/angles.h"
#include "kernels/core/error.h"
#include "kernels/projection/make_projection.h"
#include "kernels/projection/pixel_measure.h"
#include "render/lens/direct_lens.h"
#include "tests/kernels/reference_tables.h"
#include "tests/render/eye_at.h"

namespace ergodome {
namespace {

using test::ReferenceCrossing;
using test::ReferenceRay;

PixelChannels traced(const ChannelScene& scene, const std::vector<ChannelGroup>& groups) {
  return trace_channels(scene, groups, [] { return true; });
}

const std::vector<double>& values_of(const PixelChannels& found, const std::string& name) {
  const auto at = std::ranges::find_if(found.channels, [&](const PixelChannel& c) { return name == c.meaning.name; });
  if (at == found.channels.end()) {
    throw std::runtime_error("no channel " + name);
  }
  return at->values;
}

double value_of_one(const PixelChannels& found, const std::string& name) { return values_of(found, name).front(); }

//! Returns a picture with a single pixel, in the direction of a ray of a reference table.
template <class Row>
ChannelScene scene_of_one(const Row& row) {
  const Vector3<double> n = (1.0 / test::length(row.n)) * row.n;
  const Vector3<double> aside = std::abs(n.x) < 0.9 ? Vector3<double>{1.0, 0.0, 0.0} : Vector3<double>{0.0, 1.0, 0.0};
  const Vector3<double> across = cross(n, aside);
  const Vector3<double> right = (1.0 / test::length(across)) * across;
  const Vector3<double> up = cross(right, n);
  ChannelScene scene{{Spacetime{row.a}, row.r, row.theta, 0.0, row.motion, row.beta, {}, row.r, row.theta},
                     make_pinhole_projection(1, 1, 0.01)};
  const Vector3<double> columns[3] = {right, up, -1.0 * n};
  for (int j = 0; j < 3; ++j) {
    scene.eye.frame_from_view[0][j] = columns[j].x;
    scene.eye.frame_from_view[1][j] = columns[j].y;
    scene.eye.frame_from_view[2][j] = columns[j].z;
  }
  return scene;
}

Vector3<double> direction_of(double longitude_deg, double latitude_deg) {
  const double level = std::cos(one_degree * latitude_deg);
  return {level * std::cos(one_degree * longitude_deg), level * std::sin(one_degree * longitude_deg),
          std::sin(one_degree * latitude_deg)};
}

void expect_ray(const ReferenceRay& ray, const PixelChannels& found) {
  if (ray.status != LightEnd::sky) {
    for (const PixelChannel& channel : found.channels) {
      EXPECT_TRUE(std::isnan(channel.values[0])) << channel.meaning.name;
    }
    return;
  }
  const Vector3<double> sky = direction_of(value_of_one(found, "sky.longitude"), value_of_one(found, "sky.latitude"));
  const double allowed = std::max(10.0 * test::allowed_sky_error(ray), 1e-11);
  EXPECT_LT(test::length(sky - ray.sky), allowed);
  EXPECT_NEAR(value_of_one(found, "g"), ray.g, 1e-10 * ray.g);
  EXPECT_NEAR(value_of_one(found, "mino_time"), ray.mino_time, std::max(1e-9, allowed) * std::max(ray.mino_time, 1.0));
  if (ray.magnification > 0.0 && ray.kind == "random") {
    EXPECT_NEAR(std::abs(value_of_one(found, "magnification")), ray.magnification, 2e-6 * ray.magnification);
  }
}

TEST(PixelChannels, AgreeWithTheReferenceRays) {
  int magnified = 0;
  for (const ReferenceRay& ray : test::reference_rays()) {
    SCOPED_TRACE(testing::Message() << "ray " << ray.id << " " << ray.kind);
    // Skips rays less than 1e-3 rad from the edge of the shadow, where the rounding of the view's
    // axes changes the ray too much.
    if (std::abs(ray.edge_distance) < 1e-3 && ray.edge_distance != -1.0) {
      continue;
    }
    const PixelChannels found = traced(
        scene_of_one(ray), {ChannelGroup::g, ChannelGroup::sky, ChannelGroup::mino_time, ChannelGroup::magnification});
    EXPECT_EQ(found.unresolved, 0);
    expect_ray(ray, found);
    magnified += ray.status == LightEnd::sky && ray.magnification > 0.0 && ray.kind == "random" ? 1 : 0;
  }
  EXPECT_GT(magnified, 100);
}

TEST(PixelChannels, AgreeWithTheReferenceCrossingsOfTheDisk) {
  int compared = 0;
  for (const ReferenceCrossing& crossing : test::reference_crossings()) {
    SCOPED_TRACE(testing::Message() << "crossing " << crossing.id << " order " << crossing.order);
    ChannelScene scene = scene_of_one(crossing);
    scene.disk_inner = innermost_stable_radius(Spacetime{crossing.a}, 1.0);
    scene.disk_outer = 20.0;
    constexpr ChannelGroup groups[] = {ChannelGroup::disk_0, ChannelGroup::disk_1, ChannelGroup::disk_2};
    const PixelChannels found = traced(scene, {groups[crossing.order]});
    const std::string layer = "disk." + std::to_string(crossing.order);
    EXPECT_NEAR(value_of_one(found, layer + ".radius"), crossing.r_hit, 1e-9 * crossing.r_hit);
    const double turn = one_degree * value_of_one(found, layer + ".azimuth") - crossing.phi_hit;
    EXPECT_NEAR(std::remainder(turn, full_turn), 0.0, 1e-9);
    EXPECT_NEAR(value_of_one(found, layer + ".delay"), crossing.delay, 1e-9 * crossing.delay);
    EXPECT_NEAR(value_of_one(found, layer + ".g"), crossing.g_kepler, 1e-9);
    ++compared;
  }
  EXPECT_GT(compared, 50);
}

//! Returns the scene of a picture with the hole in its middle.
ChannelScene picture_of_hole(double spin, double r, ObserverMotion motion, int size_px = 41) {
  return {test::eye_at(spin, r, 0.5 * pi, motion), make_pinhole_projection(size_px, size_px, 80.0 * one_degree)};
}

TEST(PixelChannels, ShowAStaticObserverTheBlueshiftAndTheShadowOfSchwarzschild) {
  // Expected values: the blueshift of light that was at rest at infinity, and the angular radius of
  // the shadow by Synge (1966).
  const double r = 10.0;
  const double g = 1.0 / std::sqrt(1.0 - 2.0 / r);
  const double shadow = std::asin(std::sqrt(27.0 * (1.0 - 2.0 / r)) / r);
  const PixelChannels found = traced(picture_of_hole(0.0, r, ObserverMotion::fixed),
                                     {ChannelGroup::g, ChannelGroup::direction, ChannelGroup::steps});
  const std::vector<double>& shift = values_of(found, "g");
  const std::vector<double>& outwards = values_of(found, "direction.r");
  int dark = 0;
  for (std::size_t i = 0; i < shift.size(); ++i) {
    const bool in_shadow = std::acos(-outwards[i]) < shadow;
    EXPECT_EQ(std::isnan(shift[i]), in_shadow) << i;
    EXPECT_EQ(std::isnan(values_of(found, "steps")[i]), in_shadow) << i;
    if (!in_shadow) {
      EXPECT_NEAR(shift[i], g, 1e-12) << i;
    }
    dark += in_shadow ? 1 : 0;
  }
  EXPECT_GT(dark, 100);
}

TEST(PixelChannels, TurnParityOverWithEveryOrderOfSchwarzschild) {
  // Light that passes an angle s around the hole comes from a point on the sky at the angle s from
  // the camera's own position, so dΩ_sky = sin s ds dγ, where γ is the position angle around the
  // hole.
  const PixelChannels found = traced(picture_of_hole(0.0, 10.0, ObserverMotion::fixed, 201),
                                     {ChannelGroup::order, ChannelGroup::magnification, ChannelGroup::sky});
  const std::vector<double>& order = values_of(found, "order.image");
  const std::vector<double>& swept = values_of(found, "order.half_turns");
  const std::vector<double>& magnification = values_of(found, "magnification");
  int seen[3] = {0, 0, 0};
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (std::isnan(order[i])) {
      EXPECT_TRUE(std::isnan(magnification[i]) && std::isnan(swept[i])) << i;
      continue;
    }
    EXPECT_EQ(magnification[i] > 0.0, std::fmod(order[i], 2.0) == 0.0) << i;
    const Vector3<double> sky = direction_of(values_of(found, "sky.longitude")[i], values_of(found, "sky.latitude")[i]);
    EXPECT_NEAR(std::cos(pi * swept[i]), sky.x, 1e-10) << i;
    ++seen[std::min(static_cast<int>(order[i]), 2)];
  }
  EXPECT_GT(seen[0], 1000);
  EXPECT_GT(seen[1], 100);
}

TEST(PixelChannels, LeaveFlatSkyAsItIsFarFromTheHole) {
  // The camera is at 1e6 M and looks away from the hole, so the middle of the view is at longitude
  // 0 on the sky. Longitude increases to the right, which is e_φ.
  ChannelScene scene{test::eye_at(0.0, 1e6), make_pinhole_projection(3, 3, 20.0 * one_degree)};
  const double outwards[3][3] = {{0, 0, -1}, {0, -1, 0}, {-1, 0, 0}};
  std::copy(&outwards[0][0], &outwards[0][0] + 9, &scene.eye.frame_from_view[0][0]);
  const PixelChannels found =
      traced(scene, {ChannelGroup::magnification, ChannelGroup::sky, ChannelGroup::order, ChannelGroup::equatorial});
  const double side_deg = radian_deg * std::atan(std::tan(10.0 * one_degree) * 2.0 / 3.0);
  for (const double magnification : values_of(found, "magnification")) {
    EXPECT_NEAR(magnification, 1.0, 1e-5);
  }
  EXPECT_NEAR(values_of(found, "sky.longitude")[3], side_deg, 1e-4) << "left of an outward view is e_φ";
  EXPECT_NEAR(values_of(found, "sky.longitude")[5], 360.0 - side_deg, 1e-4);
  EXPECT_NEAR(values_of(found, "sky.latitude")[1], side_deg, 1e-4) << "the upper row is north";
  EXPECT_EQ(values_of(found, "order.image")[4], 0.0);
  // Without further settings, the axes of the hole are those of equatorial coordinates.
  EXPECT_EQ(values_of(found, "equatorial.ra"), values_of(found, "sky.longitude"));
  EXPECT_EQ(values_of(found, "equatorial.dec"), values_of(found, "sky.latitude"));
}

TEST(PixelChannels, AreTheNumbersBehindTheHeatMaps) {
  ChannelScene scene = picture_of_hole(0.9, 15.0, ObserverMotion::zamo, 81);
  scene.eye.theta = scene.eye.head_theta = 1.1;
  const PixelChannels found =
      traced(scene, {ChannelGroup::g, ChannelGroup::order, ChannelGroup::magnification, ChannelGroup::sky});
  const std::vector<double>& g = values_of(found, "g");
  std::vector<std::vector<float>> rooms(12, std::vector<float>(g.size()));
  LensPixels lens{};
  lens.coverage = rooms[0].data();
  lens.frequency_ratio = rooms[1].data();
  lens.half_orbits = rooms[2].data();
  for (std::size_t k = 0; k < 3; ++k) {
    lens.sky[k] = rooms[3 + k].data();
    lens.sky_along_x[k] = rooms[6 + k].data();
    lens.sky_along_y[k] = rooms[9 + k].data();
  }
  DirectLens(Backend::cpu, scene.eye, scene.projection, 0.01).fill(0, scene.projection.height_px, lens);
  int compared = 0;
  for (std::size_t i = 0; i < g.size(); ++i) {
    if (lens.coverage[i] < 1.0F) {
      continue;  // pixels on the shadow's edge contain only their lit part
    }
    ASSERT_FALSE(std::isnan(g[i])) << i;
    EXPECT_NEAR(g[i], static_cast<double>(lens.frequency_ratio[i]), 1e-5) << i;
    const double half_turns = values_of(found, "order.half_turns")[i];
    EXPECT_NEAR(half_turns, static_cast<double>(lens.half_orbits[i]), 1e-3 * half_turns) << i;
    const Vector3<float> area =
        cross(Vector3<float>{lens.sky_along_x[0][i], lens.sky_along_x[1][i], lens.sky_along_x[2][i]},
              Vector3<float>{lens.sky_along_y[0][i], lens.sky_along_y[1][i], lens.sky_along_y[2][i]});
    const double magnification = values_of(found, "magnification")[i];
    // Near caustics and the shadow, a small error of a ray in float causes a large error of its
    // magnification; these pixels are not compared.
    if (std::abs(magnification) < 10.0 && half_turns < 1.3) {
      const std::size_t row = i / 81;
      const double on_screen =
          pixel_solid_angle(scene.projection, static_cast<double>(i % 81) + 0.5, static_cast<double>(row) + 0.5);
      const double seen = on_screen / std::sqrt(static_cast<double>(dot(area, area)));
      EXPECT_NEAR(std::abs(magnification), seen, 1e-2 * seen) << i;
      ++compared;
    }
  }
  EXPECT_GT(compared, 4000);
}

TEST(PixelChannels, AreNotNumbersBesideTheImage) {
  ChannelScene scene{test::eye_at(0.5, 20.0), make_dome_projection(32, pi, 0.0)};
  const PixelChannels found = traced(scene, {ChannelGroup::g, ChannelGroup::direction});
  EXPECT_TRUE(std::isnan(values_of(found, "direction.r")[0]));
  EXPECT_TRUE(std::isnan(values_of(found, "g")[31]));
  EXPECT_FALSE(std::isnan(values_of(found, "direction.r")[16 * 32 + 16]));
}

TEST(PixelChannels, ShowTheDisksNearestCrossingBetweenItsEdges) {
  ChannelScene scene = picture_of_hole(0.9, 30.0, ObserverMotion::zamo);
  scene.projection = make_pinhole_projection(101, 101, 60.0 * one_degree);
  scene.eye.theta = scene.eye.head_theta = 1.3;
  scene.disk_inner = innermost_stable_radius(Spacetime{0.9}, 1.0);
  scene.disk_outer = 15.0;
  const PixelChannels found =
      traced(scene, {ChannelGroup::disk, ChannelGroup::disk_0, ChannelGroup::disk_1, ChannelGroup::disk_2});
  const std::vector<double>& radius = values_of(found, "disk.radius");
  int of_order[3] = {0, 0, 0};
  for (std::size_t i = 0; i < radius.size(); ++i) {
    const double of_each[3] = {values_of(found, "disk.0.radius")[i], values_of(found, "disk.1.radius")[i],
                               values_of(found, "disk.2.radius")[i]};
    const auto* const first = std::ranges::find_if(of_each, [](double r) { return !std::isnan(r); });
    if (first == std::end(of_each)) {
      EXPECT_TRUE(std::isnan(radius[i])) << i;
      continue;
    }
    EXPECT_EQ(radius[i], *first) << i;
    EXPECT_EQ(values_of(found, "disk.order")[i], static_cast<double>(first - of_each)) << i;
    EXPECT_GE(radius[i], scene.disk_inner);
    EXPECT_LE(radius[i], scene.disk_outer);
    ++of_order[first - of_each];
  }
  EXPECT_GT(of_order[0], 100);
  EXPECT_GT(of_order[1], 3);
}

TEST(ChannelGroups, AreReadFromAList) {
  const std::vector<ChannelGroup> wanted = {ChannelGroup::g, ChannelGroup::disk_1, ChannelGroup::color};
  EXPECT_EQ(channel_groups("g,disk.1,color"), wanted);
  for (const char* list : {"", "g,", ",g", "g,,sky", "g,g", "G", "redshift"}) {
    EXPECT_THROW(channel_groups(list), Error) << list;
  }
}

}  // namespace
}  // namespace ergodome
