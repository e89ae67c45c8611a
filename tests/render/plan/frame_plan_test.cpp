#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "content/show/animated_show.h"
#include "content/show/reading/show_reader.h"
#include "render/frame/frame_passes.h"
#include "render/passes/shells/shell_pass.h"
#include "tests/render/plan/frame_plan_scenes.h"

namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): scenes of tests

TEST_F(FramePlans, OfAPlainSkyNameRaysAndLightAlone) {
  const FramePlan plan = plan_frame(plain_show(), request());
  std::vector<std::string> names;
  names.reserve(plan.passes.size());
  for (const PlannedPass& pass : plan.passes) {
    names.push_back(pass.name);
  }
  EXPECT_THAT(names, testing::ElementsAre("trace_pixels, footprints", "shade_sky"));
  EXPECT_EQ(plan.lens, "direct");
}

TEST_F(FramePlans, NameTheDiskAndWhatCallsForIt) {
  Show show = plain_show();
  show.disk.emplace();
  show.lines["disk"] = 7;
  const FramePlan plan = plan_frame(show, request());
  const auto disk = std::ranges::find(plan.passes, "draw_disk", &PlannedPass::name);
  ASSERT_NE(disk, plan.passes.end());
  EXPECT_THAT(disk->why, testing::HasSubstr("line 7"));
  EXPECT_EQ(disk->elements, static_cast<long>(plan.width_px) * plan.height_px);
}

TEST_F(FramePlans, NameTheShellsAndWhatCallsForThem) {
  Show show = plain_show();
  show.shells.resize(3);
  show.lines["shells"] = 7;
  const FramePlan plan = plan_frame(show, request());
  const auto pass = std::ranges::find(plan.passes, "draw_shells", &PlannedPass::name);
  ASSERT_NE(pass, plan.passes.end());
  EXPECT_THAT(pass->why, testing::HasSubstr("line 7"));
  EXPECT_EQ(pass->elements, static_cast<long>(plan.width_px) * plan.height_px);
  const auto buffer = std::ranges::find(plan.buffers, "buffer: shells", &PlannedBuffer::name);
  ASSERT_NE(buffer, plan.buffers.end());
  EXPECT_EQ(buffer->bytes, 3 * ShellPass::shell_bytes);
  show.disk.emplace();
  const FramePlan with_disk = plan_frame(show, request());
  EXPECT_NE(std::ranges::find(with_disk.passes, "draw_shells, disk", &PlannedPass::name), with_disk.passes.end());
  EXPECT_EQ(std::ranges::find(with_disk.passes, "draw_disk", &PlannedPass::name), with_disk.passes.end());
}

TEST_F(FramePlans, OfShellsThatNobodySeesTraceNoneOfThem) {
  Show show = plain_show();
  show.shells.resize(1);
  show.shells[0].line_opacity = 0.0;
  const FramePlan plan = plan_frame(show, request());
  EXPECT_EQ(std::ranges::find(plan.passes, "draw_shells", &PlannedPass::name), plan.passes.end());
  expect_as_planned(show, request());
}

TEST_F(FramePlans, NameTheLineThatAnimatesAnEffect) {
  const FramePlan plan = plan_frame(animated(plain_show(), "effects.bloom.strength", 0.2), request());
  const auto bloom = std::ranges::find(plan.passes, "add_bloom", &PlannedPass::name);
  ASSERT_NE(bloom, plan.passes.end());
  EXPECT_TRUE(bloom->if_needed);
  EXPECT_THAT(bloom->why, testing::HasSubstr("animated from line 99"));
  const auto trails = std::ranges::find(plan.passes, "follow_trails", &PlannedPass::name);
  ASSERT_NE(trails, plan.passes.end());
  EXPECT_FALSE(trails->if_needed);
}

TEST_F(FramePlans, OfPicturesInBlocksCountEach) {
  Show show = plain_show();
  show.view.size_px = 1500;
  FrameRequest asked = request();
  asked.lens = LensChoice::direct;
  expect_as_planned(show, asked);
}

TEST_F(FramePlans, OfTwoEyesThatAreMadeInTurnCountTheirStrips) {
  Show show = plain_show();
  show.view.size_px = 700;
  show.stereo.layout = StereoLayout::separate;
  show.stereo.baseline = 0.1;
  for (const LensChoice lens : {LensChoice::live, LensChoice::direct}) {
    for (const double convergence : {0.0, 10.0}) {
      show.stereo.convergence = convergence;
      FrameRequest asked = request();
      asked.lens = lens;
      expect_as_planned(show, asked);
    }
  }
}

TEST_F(FramePlans, NameTheLinesThatCallForAPass) {
  const Show show = parse_show("[camera]\n[[camera.key]]\nr = 9\n[sky]\nmap = \"grid\"\n\n[effects]\nredshift = true\n",
                               "folder/scene.toml");
  const FramePlan plan = plan_frame(show, request());
  EXPECT_EQ(plan.passes.back().name, "shade_sky, luminance");
  EXPECT_EQ(plan.passes.back().why, "sky.filter (by default), effects.redshift (scene.toml line 8)");
  EXPECT_EQ(plan.channels[2].why, "sky.map (scene.toml line 5)");
}

TEST_F(FramePlans, LeaveOutEffectsWithoutStrength) {
  Show show = plain_show();
  show.sky.stars = "bright_stars";
  show.effects.bloom = BloomSettings{0.0, 40.0};
  show.effects.diffraction = DiffractionSettings{};
  show.effects.diffraction->strength = 0.0;
  show.effects.trails = TrailSettings{0.0};
  for (const PlannedPass& pass : plan_frame(show, request()).passes) {
    EXPECT_THAT(pass.name, testing::Not(testing::AnyOf("add_bloom", "draw_spikes", "follow_trails", "clear_outside")));
  }
  expect_as_planned(show, request());
}

}  // namespace
}  // namespace ergodome
