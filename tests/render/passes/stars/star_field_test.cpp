#include "render/passes/stars/star_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "kernels/launch/launch.h"
#include "tests/render/passes/stars/star_cameras.h"

namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the cameras and stars of these tests

//! Returns a patch that covers a rectangle of the sky, in a random direction.
BezierPatch random_patch(std::mt19937& random, double size) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0.3, 1.0);
  const auto direction = [&] { return unit_of({normal(random), normal(random), normal(random)}); };
  const Vector3<double> axis = direction();
  const Vector3<double> first = unit_of(cross(axis, direction()));
  const Vector3<double> second = cross(axis, first);
  const double width = size * uniform(random);
  const double height = 0.1 * size * uniform(random);
  BezierPatch patch{};
  for (int i = 0; i < 16; ++i) {
    const int column = i % 4;
    const int row = i / 4;
    const Vector3<double> p = axis + (width * (column - 1.5 + 0.2 * normal(random))) * first +
                              (height * (row - 1.5 + 0.2 * normal(random))) * second;
    patch.x[i] = static_cast<float>(p.x);
    patch.y[i] = static_cast<float>(p.y);
    patch.z[i] = static_cast<float>(p.z);
  }
  return patch;
}

//! Returns how deep inside a frustum a direction is: the sine of the angle from its nearest side.
//! The value is negative if it is outside.
double depth_in(const SkyFrustum& frustum, const Vector3<double>& d) {
  double depth = 1.0;
  for (const Vector3<double>& inward : frustum.inward) {
    depth = std::min(depth, dot(inward, d));
  }
  return depth;
}

float illuminance_of(double magnitude) {
  return static_cast<float>(illuminance_of_magnitude_0 * std::pow(10.0, -0.4 * magnitude));
}

//! Returns whether a star is at least as bright as the limit, including the gain by a frequency
//! shift.
bool is_from(const StarFloor& floor, const StarField& field, const FieldStar& star) {
  const float gain =
      field.gains().row(floor.shift_row).gain[static_cast<std::size_t>(star_class(star.log_temperature))];
  return star.illuminance * gain >= floor.illuminance;
}

TEST(SkyFrustum, HoldsItsPatchAndLittleElse) {
  std::mt19937 random(5);
  for (int round = 0; round < 100; ++round) {
    const BezierPatch patch = random_patch(random, 0.2);
    const Vector3<double> corners =
        control_point(patch, 0) + control_point(patch, 3) + control_point(patch, 12) + control_point(patch, 15);
    const PatchFrame frame = frame_of(patch, unit_of(corners));
    const SkyFrustum frustum = frustum_of(in_frame(patch, frame), frame);
    for (int i = 0; i < 16; ++i) {
      EXPECT_GE(depth_in(frustum, unit_of(control_point(patch, i))), 0.0);
    }
    // The patch is at most 0.6 by 0.06 rad. Its control points deviate at random from a regular
    // grid, by about a fifth of the distance between grid points.
    EXPECT_LT(solid_angle(frustum), 0.2 * 0.02 * 6.0 * 6.0);
  }
}

TEST(SkyBounds, HoldTheirFrustumAboutThePolesAndAcrossTheSeam) {
  std::mt19937 random(23);
  std::normal_distribution<double> normal;
  int about_poles = 0;
  int across_seam = 0;
  for (int round = 0; round < 400; ++round) {
    const BezierPatch patch = random_patch(random, round % 2 == 0 ? 0.2 : 0.02);
    const PatchFrame frame = frame_of(patch, unit_of(control_point(patch, 5)));
    const SkyFrustum frustum = frustum_of(in_frame(patch, frame), frame);
    const SkyBounds bounds = bounds_of(frustum);
    about_poles += bounds.width_turns == 1.0F ? 1 : 0;
    across_seam += bounds.turns + bounds.width_turns > 1.0F ? 1 : 0;
    for (int i = 0; i < 300; ++i) {
      const Vector3<double> d =
          unit_of(frame.axis + (0.3 * normal(random)) * frame.first + (0.1 * normal(random)) * frame.second);
      if (depth_in(frustum, d) < 0.0) {
        continue;
      }
      ASSERT_GE(d.z, static_cast<double>(bounds.low));
      ASSERT_LE(d.z, static_cast<double>(bounds.high));
      const double turns = std::atan2(d.y, d.x) / (2.0 * pi) - static_cast<double>(bounds.turns);
      ASSERT_LE(turns - std::floor(turns), static_cast<double>(bounds.width_turns));
    }
  }
  EXPECT_GT(about_poles, 0);
  EXPECT_GT(across_seam, 0);
}

TEST(SkyBounds, TurnWithTheSky) {
  const SkyPart part = {{{0.6F, 0.8F, 0.0F}}, {-0.25F, 0.5F, 0.75F, 0.125F}};
  const SkyPart turned_part = turned(part, sky_rotation(pi), true);
  EXPECT_NEAR(turned_part.inward[0][0], -0.6F, 1e-6F);
  EXPECT_NEAR(turned_part.inward[0][1], -0.8F, 1e-6F);
  const SkyBounds& other = turned_part.bounds;
  EXPECT_EQ(other.low, -0.5F);
  EXPECT_EQ(other.high, 0.25F);
  EXPECT_EQ(other.turns, 0.25F);
  EXPECT_EQ(other.width_turns, 0.125F);
}

TEST(StarField, SearchVisitsOnceWhatAFrustumHolds) {
  const StarField field(brightest(20'000), glm::dmat3(1.0), colours().view());
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform;
  const SearchedField view = field.view(host_data);
  std::vector<int> found(field.stars().size());
  for (int round = 0; round < 200; ++round) {
    const BezierPatch patch = random_patch(random, std::pow(uniform(random), 3.0));
    const PatchFrame frame = frame_of(patch, unit_of(control_point(patch, 5)));
    const SkyFrustum frustum = frustum_of(in_frame(patch, frame), frame);
    // Every second search includes the change of brightness by a frequency shift.
    const int row = round % 2 == 0 ? ShiftGains::unshifted_row()
                                   : ShiftGains::row_of(static_cast<float>(0.5 + 2.0 * uniform(random)));
    const float faintest = illuminance_of(9.0 * uniform(random));
    int count = 0;
    run_on_this_thread(StarSearchBatch{&view, sky_part(frustum), {faintest, row}, found.data(), &count});
    std::vector<int> times(field.stars().size());
    for (int i = 0; i < count; ++i) {
      ++times[static_cast<std::size_t>(found[static_cast<std::size_t>(i)])];
    }
    for (std::size_t i = 0; i < times.size(); ++i) {
      const FieldStar& star = field.stars()[i];
      const double depth = depth_in(frustum, star.direction);
      if (std::abs(depth) > 2e-7) {
        const bool bright = is_from({faintest, row}, field, star);
        ASSERT_EQ(times[i], depth > 0.0 && bright ? 1 : 0) << star.number;
      }
    }
  }
}

TEST(StarField, CountsTheStarsThatShineBrightEnough) {
  const StarField field(brightest(20'000), glm::dmat3(1.0), colours().view());
  for (const int row :
       {ShiftGains::unshifted_row(), ShiftGains::row_of(0.3F), ShiftGains::row_of(1.1F), ShiftGains::row_of(4.0F)}) {
    for (double magnitude = -3.0; magnitude < 14.0; magnitude += 0.5) {
      const auto count = [&](float faintest) {
        return std::ranges::count_if(field.stars(), [&](const FieldStar& star) {
          return is_from({faintest, row}, field, star);
        });
      };
      const float faintest = illuminance_of(magnitude);
      EXPECT_GE(field.count_from({faintest, row}), count(faintest));
      EXPECT_LE(field.count_from({faintest, row}), count(0.94F * faintest));
    }
  }
}

TEST(ShiftGains, AreNeverLessThanWhatAStarGains) {
  const ShiftGains gains(colours().view());
  for (double g = 1e-3; g < 9e5; g *= 1.07) {
    const ShiftGain& row = gains.row(ShiftGains::row_of(static_cast<float>(g)));
    for (double temperature_k = 1611.0; temperature_k < 30'000.0; temperature_k *= 1.05) {
      const auto log_temperature = static_cast<float>(std::log(temperature_k));
      const double gained = blackbody_tristimulus(g * temperature_k).y / blackbody_tristimulus(temperature_k).y;
      const auto bound = static_cast<double>(row.gain[static_cast<std::size_t>(star_class(log_temperature))]);
      ASSERT_GE(bound, 0.999 * gained - 1e-30) << g << ", " << temperature_k << " K";
      // For the frequency shifts and temperatures of most stars, the upper bound is at most three
      // times the gain.
      if (g > 0.5 && g < 2.0 && temperature_k > 3000.0) {
        ASSERT_LE(bound, 3.0 * gained) << g << ", " << temperature_k << " K";
      }
    }
  }
}

TEST(BezierPatch, IsThePatchOfTheLensGrid) {
  GridSettings settings;
  settings.budget_px = 1.0;
  const LensStation station = build_lens_station(Spacetime{0.9}, 6.0, 1.0, settings);
  const LensGrid grid = grid_view(station);
  const auto boxes = leaf_boxes(station);
  for (std::size_t leaf = 0; leaf < boxes.size(); leaf += 7) {
    const auto width = static_cast<float>(boxes[leaf].width_turns);
    const auto height = static_cast<float>(boxes[leaf].height);
    const BezierPatch patch = bezier_patch(grid, static_cast<int>(leaf), width, height);
    BezierPatch xz = patch;
    std::copy_n(patch.z, 16, xz.y);
    for (const auto& [u, v] : {std::pair{0.0F, 0.0F}, {0.3F, 0.8F}, {0.5F, 0.5F}, {1.0F, 0.2F}}) {
      const PatchValue read = patch_value(grid.nodes, grid.leaves + 4 * leaf, u, v, width, height);
      const PlaneValue<float> value = seen_from(xz, 0.0F, 0.0F, u, v);
      EXPECT_NEAR(value.p, quad_part(read.sky, 0), 2e-6F);
      EXPECT_NEAR(value.q, quad_part(read.sky, 2), 2e-6F);
      EXPECT_NEAR(value.p_u, width * quad_part(read.along_gamma, 0), 2e-5F);
      EXPECT_NEAR(value.q_v, height * quad_part(read.along_s, 2), 2e-5F);
    }
  }
}

}  // namespace
}  // namespace ergodome
