#include <gmock/gmock.h>

#include "render/accuracy/accuracy.h"
#include "render/accuracy/axes/axes.h"
#include "render/accuracy/axes/picture_race.h"
#include "tests/render/accuracy/accuracy_scene.h"
#include "tests/support/sanitized.h"

namespace ergodome {
namespace {

using testing::ElementsAre;

std::vector<std::string> axes_of(const Show& show) { return accuracy_axes(show, test::few()); }

Show approaching() {
  Show show = test::small_dome();
  show.duration_s = 10.0;
  show.camera.keys.push_back(show.camera.keys.front());
  show.camera.keys.back().time_s = 10.0;
  show.camera.keys.back().r = 30.0;
  show.quality.budget_px = 0.02;
  return show;
}

Show starry() {
  Show show = test::small_dome();
  show.sky.stars = "bright_stars";
  show.sky.faintest_mag = 4.0;
  show.effects.magnification = true;
  return show;
}

TEST(AccuracyAxes, OfAStillShowWithoutStarsHaveNeitherStationsNorStars) {
  EXPECT_THAT(axes_of(test::small_dome()), ElementsAre("rays", "lens", "map", "frame"));
}

TEST(AccuracyAxes, OfAShowThatCallsForNoFootprintsHaveNoLensWithThem) {
  Show show = test::small_dome();
  show.sky.filter = SkyFilter::point;
  EXPECT_THAT(axes_of(show), ElementsAre("rays", "map", "frame"));
}

TEST(AccuracyAxes, OfAStarryShowWhoseCameraMovesAreAll) {
  Show show = approaching();
  show.sky.stars = "bright_stars";
  EXPECT_THAT(axes_of(show), ElementsAre("rays", "lens", "stations", "map", "stars", "frame"));
}

TEST(AccuracyAxes, AreThoseThatAreAskedFor) {
  AccuracySettings settings = test::few();
  settings.axes = {"stars", "map"};
  EXPECT_THAT(accuracy_axes(test::small_dome(), settings), ElementsAre("map"));
}

TEST(AccuracyAxes, AreWhatAReportHas) {
  AccuracySettings settings = test::few();
  settings.axes = {"map", "frame"};
  const AccuracyReport report = measure_accuracy(test::small_dome(), settings, {});
  ASSERT_EQ(report.axes.size(), 2U);
  EXPECT_EQ(report.axes[1].name, "frame");
  EXPECT_EQ(report.width_px, 48);
  EXPECT_NEAR(report.pixel_arcmin, 180.0 * 60.0 / 48.0, 1e-9);
  EXPECT_FALSE(report.notes.empty());
  // The settings of this axis are direct rays with errors of a quarter and a thousandth of a pixel.
  // Their pictures must be the same.
  EXPECT_LT(report.axes[1].choices[0].error.median, 0.01);
}

TEST(AccuracyAxes, OfAMovingCameraHaveStationsAndThoseFartherApartMissByMore) {
  const Show show = approaching();
  AccuracySettings settings = test::few();
  const auto axis = measure_stations(show, accuracy_moments(show, settings), settings, {});
  ASSERT_TRUE(axis);
  ASSERT_EQ(axis->choices.size(), 10U);
  // In the first five choices, stations have derivatives along r and θ, the others do not. In each
  // group, the distance between stations is halved four times.
  EXPECT_GT(axis->choices[5].error.p99, 3.0 * axis->choices[7].error.p99);
  EXPECT_GT(axis->choices[5].error.p99, axis->choices[0].error.p99);
  EXPECT_LT(axis->choices[0].disk_bytes.value(), axis->choices[2].disk_bytes.value());
}

TEST(AccuracyAxes, OfAnAnimatedSpinHaveNoStations) {
  Show show = approaching();
  show.timeline.animations.push_back({"hole.spin", {{0.0, 0.1}, {10.0, 0.9}}});
  const AccuracySettings settings = test::few();
  EXPECT_FALSE(measure_stations(show, accuracy_moments(show, settings), settings, {}));
}

TEST(AccuracyAxes, OfStarsFindTheInvertedImagesExactAndTheGatheredWithinTheirPixels) {
  if (test::sanitized) {
    GTEST_SKIP() << "many rays";
  }
  const Show show = starry();
  AccuracySettings settings = test::few();
  settings.size_px = 256;
  const auto axis = measure_stars(show, accuracy_moments(show, settings), settings, {});
  ASSERT_TRUE(axis);
  ASSERT_EQ(axis->choices.size(), 2U);
  EXPECT_GT(axis->choices[0].error.count, 100U);
  EXPECT_LT(axis->choices[0].error.p99, 0.01);
  EXPECT_LT(axis->choices[0].light_error.value().median, 1e-3);
  EXPECT_LT(axis->choices[0].lost, 0.01);
  EXPECT_LT(axis->choices[1].error.median, 0.1);
  EXPECT_GT(axis->choices[1].error.p99, axis->choices[0].error.p99);
}

TEST(AccuracyAxes, OfTheMapFindThePolygonNearestToTheFinerOnes) {
  AccuracySettings settings = test::few();
  settings.lattice = 48;
  const AccuracyAxis axis = measure_map(test::small_dome(), settings, {});
  ASSERT_EQ(axis.choices.size(), 3U);
  EXPECT_LT(axis.choices[2].error.median, axis.choices[1].error.median);
  EXPECT_LT(axis.choices[2].error.median, axis.choices[0].error.median);
  EXPECT_FALSE(axis.choices[0].passes_ms.empty());
}

TEST(AveragedPicture, HoldsTheMeansOfItsBlocks) {
  Picture picture;
  picture.width = 4;
  picture.height = 2;
  for (int i = 0; i < 8; ++i) {
    for (const float part : {1.0F, 2.0F, 3.0F, 1.0F}) {
      picture.rgba.push_back(part * static_cast<float>(i));
    }
  }
  const Picture mean = averaged(picture, 2);
  EXPECT_EQ(mean.width, 2);
  EXPECT_EQ(mean.height, 1);
  EXPECT_THAT(mean.rgba, ElementsAre(2.5F, 5.0F, 7.5F, 2.5F, 4.5F, 9.0F, 13.5F, 4.5F));
}

}  // namespace
}  // namespace ergodome
