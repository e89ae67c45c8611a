#include "app/budget/settings_ladder.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace ergodome {
namespace {

//! Returns settings in the order of a measurement: lenses from coarse to fine, then direct rays,
//! then the finest lens with the point filter for the sky map.
std::vector<MeasuredSetting> measured_settings() {
  std::vector<MeasuredSetting> settings;
  for (const double lens_px : {2.0, 1.0, 0.5, 0.25}) {
    settings.push_back({{lens_px, LensChoice::automatic, SkyFilter::ewa}, 0.5 * lens_px, 40.0 / lens_px, 2.0, 80.0});
  }
  settings.push_back({{0.25, LensChoice::direct, SkyFilter::ewa}, 0.03, 0.0, 2.0, 200.0});
  settings.push_back({{0.25, LensChoice::automatic, SkyFilter::point}, 0.125, 160.0, 2.0, 40.0});
  return settings;
}

LadderLimits limits_of(int narrowest_px) { return {1024, narrowest_px, 1.0, 15.0, 150'000.0}; }

TEST(SettingsLadder, GetsQuickerFromRungToRung) {
  for (const Budget& budget : {Budget{0.3, 30.0}, Budget{std::nullopt, 30.0}}) {
    const std::vector<Rung> ladder = settings_ladder(measured_settings(), budget, limits_of(192));
    ASSERT_GT(ladder.size(), 5U);
    EXPECT_TRUE(std::ranges::is_sorted(ladder, std::greater<>(), &Rung::frame_ms));
  }
}

TEST(SettingsLadder, KeepsToTheErrorAsLongAsSmallerPicturesHelp) {
  const std::vector<Rung> ladder = settings_ladder(measured_settings(), {0.3, 30.0}, limits_of(192));
  const auto beyond = std::ranges::find_if(ladder, [](const Rung& rung) { return !is_within(rung.error_px, 0.3); });
  for (const Rung& rung : std::span(ladder.begin(), beyond)) {
    EXPECT_EQ(rung.quality.budget_px, 0.25);
  }
  for (const Rung& rung : std::span(beyond, ladder.end())) {
    EXPECT_EQ(rung.size_px, 192);
  }
}

TEST(SettingsLadder, GoesFromTheWholeToTheNarrowestInStepsOfAThirdOfThePixels) {
  const std::vector<Rung> ladder = settings_ladder(measured_settings(), {0.3, 30.0}, limits_of(192));
  EXPECT_EQ(ladder.front().size_px, 1024);
  EXPECT_EQ(ladder.back().size_px, 192);
  for (std::size_t i = 1; i < ladder.size(); ++i) {
    EXPECT_GE(ladder[i].size_px, 0.81 * ladder[i - 1].size_px);
  }
}

TEST(SettingsLadder, KeepsASizeThatIsFixed) {
  for (const Rung& rung : settings_ladder(measured_settings(), {std::nullopt, 30.0}, limits_of(1024))) {
    EXPECT_EQ(rung.size_px, 1024);
  }
}

TEST(SettingsLadder, WithoutAnErrorBeginsWithTheFinestLensThatTakesLonger) {
  const std::vector<Rung> ladder = settings_ladder(measured_settings(), {std::nullopt, 30.0}, limits_of(192));
  EXPECT_EQ(ladder.front().quality.budget_px, 0.25);
  // A lens that is built within its time limit does not slow down frames, so a coarser lens would
  // gain nothing. The next rung has a smaller picture instead.
  EXPECT_LT(ladder[1].size_px, 1024);
}

TEST(SettingsLadder, LooksPlainlyAtTheMapOnlyInTheSmallestPictures) {
  const std::vector<Rung> ladder = settings_ladder(measured_settings(), {std::nullopt, 30.0}, limits_of(512));
  for (const Rung& rung : ladder) {
    EXPECT_TRUE(rung.quality.filter == SkyFilter::ewa || rung.size_px == 512);
  }
  EXPECT_EQ(ladder.back().quality.filter, SkyFilter::point);
}

TEST(SettingsLadder, ForetellsSmallPicturesByDirectRays) {
  const std::vector<Rung> ladder = settings_ladder(measured_settings(), {0.3, 30.0}, limits_of(192));
  const auto smallest = std::ranges::find_if(ladder, [](const Rung& rung) { return rung.size_px == 192; });
  ASSERT_NE(smallest, ladder.end());
  EXPECT_NEAR(smallest->frame_ms, 2.0 + 200.0 * 192 * 192 / (1024.0 * 1024.0), 1e-9);
}

TEST(SettingsLadder, LeavesAFilterByPolygonsAlone) {
  std::vector<MeasuredSetting> settings = measured_settings();
  settings.pop_back();
  for (MeasuredSetting& setting : settings) {
    setting.quality.filter = SkyFilter::polygon;
  }
  for (const Rung& rung : settings_ladder(settings, {std::nullopt, 30.0}, limits_of(192))) {
    EXPECT_EQ(rung.quality.filter, SkyFilter::polygon);
  }
}

TEST(SettingsLadder, BeginsWhereAFrameLeavesRoom) {
  const std::vector<Rung> ladder = settings_ladder(measured_settings(), {0.3, 30.0}, limits_of(192));
  const std::size_t first = first_rung(ladder, 60.0);
  ASSERT_GT(first, 0U);
  EXPECT_LE(ladder[first].frame_ms, 39.0);
  EXPECT_GT(ladder[first - 1].frame_ms, 39.0);
}

TEST(SettingsLadder, BeginsWithTheSmallestPicturesWhereNothingIsQuickEnough) {
  const std::vector<Rung> ladder = settings_ladder(measured_settings(), {0.3, 1000.0}, limits_of(192));
  const Rung& rung = ladder[first_rung(ladder, 1.0)];
  EXPECT_EQ(rung.size_px, 192);
  EXPECT_EQ(rung.quality, ladder.front().quality);
}

TEST(SettingsLadder, IsWholeWhereNoTimeIsKnown) {
  std::vector<MeasuredSetting> settings = measured_settings();
  for (MeasuredSetting& setting : settings) {
    setting.fixed_ms = std::numeric_limits<double>::quiet_NaN();
  }
  const std::vector<Rung> ladder = settings_ladder(settings, {0.3, 30.0}, limits_of(192));
  EXPECT_GT(ladder.size(), 5U);
  EXPECT_EQ(ladder[first_rung(ladder, 33.0)].size_px, 192);
}

}  // namespace
}  // namespace ergodome
