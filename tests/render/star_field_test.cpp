#include "render/stars/star_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "render/stars/bezier_patch.h"
#include "tests/render/star_cameras.h"

namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the cameras and stars of these tests

TEST(StarField, ConeSearchFindsAllThatItHolds) {
  const StarField field(brightest(20'000), glm::dmat3(1.0), colours().view());
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  for (int round = 0; round < 200; ++round) {
    const Vector3<double> axis = unit_of({normal(random), normal(random), normal(random)});
    const double half_angle = std::pow(uniform(random), 3.0);
    const float faintest =
        static_cast<float>(illuminance_of_magnitude_0 * std::pow(10.0, -0.4 * 9.0 * uniform(random)));
    std::vector<int> times(field.stars().size());
    field.search(axis, std::sin(half_angle), std::cos(half_angle), faintest, [&](int star) {
      ++times[static_cast<std::size_t>(star)];
      return true;
    });
    for (std::size_t i = 0; i < times.size(); ++i) {
      const FieldStar& star = field.stars()[i];
      ASSERT_LE(times[i], 1);
      if (dot(star.direction, axis) > std::cos(half_angle) && star.illuminance >= faintest) {
        ASSERT_EQ(times[i], 1) << star.number;
      }
    }
  }
}

TEST(BezierPatch, IsThePatchOfTheLensGrid) {
  GridSettings settings;
  settings.budget_px = 1.0;
  const LensStation station = build_lens_station(0.9, 6.0, 1.0, settings);
  const LensGrid grid = grid_view(station);
  const auto boxes = leaf_boxes(station);
  for (std::size_t leaf = 0; leaf < boxes.size(); leaf += 7) {
    const auto width = static_cast<float>(boxes[leaf].width_turns);
    const auto height = static_cast<float>(boxes[leaf].height);
    const BezierPatch patch = bezier_patch(grid, static_cast<int>(leaf), width, height);
    PlanePatch plane{};
    std::copy_n(patch.x, 16, plane.p);
    std::copy_n(patch.z, 16, plane.q);
    for (const auto& [u, v] : {std::pair{0.0F, 0.0F}, {0.3F, 0.8F}, {0.5F, 0.5F}, {1.0F, 0.2F}}) {
      const PatchValue read = patch_value(grid.nodes, grid.leaves + 4 * leaf, u, v, width, height);
      const PlaneValue value = evaluate(plane, u, v);
      EXPECT_NEAR(value.p, quad_part(read.sky, 0), 2e-6F);
      EXPECT_NEAR(value.q, quad_part(read.sky, 2), 2e-6F);
      EXPECT_NEAR(value.p_u, width * quad_part(read.along_gamma, 0), 2e-5F);
      EXPECT_NEAR(value.q_v, height * quad_part(read.along_s, 2), 2e-5F);
    }
  }
}

}  // namespace
}  // namespace ergodome
