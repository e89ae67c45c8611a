#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <string_view>
#include <thread>

#include "kernels/launch/launch.h"
#include "kernels/near_field/look_up_disk.h"
#include "kernels/projection/pixel_measure.h"
#include "render/eyes/view_projection.h"
#include "tests/render/plan/frame_plan_scenes.h"
#include "tests/support/baked_show.h"

// Tests of the plans of pictures with a disk and shells, drawn by rays and by grids, for one eye
// and two.
namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): scenes of tests

bool plans(const FramePlan& plan, std::string_view pass) {
  return std::ranges::any_of(plan.passes, [&](const PlannedPass& each) { return each.name == pass; });
}

TEST_F(FramePlans, HoldForWhatStandsNearTheHoleInEyesThatTurn) {
  for (const double baseline : {0.0, 0.1}) {
    SCOPED_TRACE(baseline);
    Show show = plain_show();
    for (const Effect& effect : effects()) {
      if (std::string_view(effect.name) == "disk" || std::string_view(effect.name) == "shells") {
        effect.add(show);
      }
    }
    show.stereo.layout = StereoLayout::separate;
    show.stereo.model = StereoModel::omni;
    show.stereo.baseline = baseline;
    expect_as_planned(show, request());
  }
}

TEST_F(FramePlans, HoldForWhatStandsNearTheHoleInEyesOfOneLens) {
  for (const LensChoice lens : {LensChoice::automatic, LensChoice::live, LensChoice::direct}) {
    for (const double baseline : {0.0, 0.1}) {
      for (const unsigned things : {1U, 2U, 3U}) {
        SCOPED_TRACE(testing::Message() << static_cast<int>(lens) << " " << baseline << " " << things);
        Show show = plain_show();
        show.camera.keys[0].r = show.camera.keys[1].r = 30.0;
        for (const Effect& effect : effects()) {
          const std::string_view name = effect.name;
          if ((name == "clouds" && (things & 1U) != 0U) || (name == "shells" && (things & 2U) != 0U)) {
            effect.add(show);
          }
        }
        show.stereo.layout = StereoLayout::separate;
        show.stereo.model = StereoModel::flat;
        show.stereo.baseline = baseline;
        FrameRequest asked = request();
        asked.lens = lens;
        expect_as_planned(show, asked);
        const bool by_grid = things == 1U && lens == LensChoice::live && baseline > 0.0;
        EXPECT_EQ(plans(plan_frame(show, asked), "look_up_flat_eyes, pattern"), by_grid);
      }
    }
  }
}

TEST_F(FramePlans, HoldForEyesOfOneLensThatMoveApart) {
  Show show = plain_show();
  show.disk.emplace();
  show.shells.emplace_back();
  show.shells[0].radius = 3.0;
  show.stereo.layout = StereoLayout::separate;
  show.stereo.model = StereoModel::flat;
  show.lines["animate.stereo.baseline"] = 99;
  show.timeline.animations.push_back({"stereo.baseline", {{0.0, 0.0}, {1.0, 0.2}}});
  expect_as_planned(show, request());
  show.shells.clear();
  expect_as_planned(show, request());
}

TEST_F(FramePlans, HoldForADiskThatComesAndGoesInEyesOfOneLens) {
  Show show = plain_show();
  show.disk.emplace();
  show.stereo.layout = StereoLayout::separate;
  show.stereo.model = StereoModel::flat;
  show.stereo.baseline = 0.1;
  show.lines["animate.disk.opacity"] = 99;
  for (const double opacity : {0.0, 1.0}) {
    show.timeline.animations = {{"disk.opacity", {{0.0, opacity}, {0.6, opacity}, {1.0, 1.0 - opacity}}}};
    expect_as_planned(show, request());
  }
}

TEST_F(FramePlans, HoldForADiskInAGrid) {
  for (const LensChoice lens : {LensChoice::live, LensChoice::direct}) {
    for (const bool clouds : {false, true}) {
      for (const bool stereo : {false, true}) {
        SCOPED_TRACE(testing::Message() << static_cast<int>(lens) << clouds << stereo);
        Show show = plain_show();
        show.disk.emplace();
        show.disk->pattern = clouds ? DiskPattern::procedural : DiskPattern::none;
        if (stereo) {
          show.stereo.layout = StereoLayout::separate;
          show.stereo.baseline = 0.1;
        }
        FrameRequest asked = request();
        asked.lens = lens;
        expect_as_planned(show, asked);
        const FramePlan plan = plan_frame(show, asked);
        EXPECT_EQ(plans(plan, disk_look_up_name(clouds ? DiskDrawing::pattern : DiskDrawing::plain)),
                  lens == LensChoice::live);
        EXPECT_EQ(plans(plan, near_field_name(clouds ? DiskDrawing::pattern : DiskDrawing::plain, false)),
                  lens == LensChoice::direct);
      }
    }
  }
}

TEST_F(FramePlans, HoldForADiskInALargePicture) {
  Show show = plain_show();
  show.disk.emplace();
  show.view.size_px = 520;
  expect_as_planned(show, request());
  EXPECT_TRUE(plans(plan_frame(show, request()), "trace_disk_nodes"));
}

TEST_F(FramePlans, HoldForADiskInAGridRoundObjects) {
  FrameRequest asked = request();
  asked.lens = LensChoice::live;
  Show show = plain_show();
  show.disk.emplace();
  ObjectSettings& ball = show.objects.emplace_back();
  ball.form = ObjectForm::sphere;
  ball.method = ObjectMethod::trace;
  ball.position = {12.0, 4.0, 0.5};
  expect_as_planned(show, asked);
  const FramePlan plan = plan_frame(show, asked);
  EXPECT_TRUE(plans(plan, disk_look_up_name(DiskDrawing::plain)));
  EXPECT_TRUE(plans(plan, near_field_name(DiskDrawing::plain, false)));
}

TEST_F(FramePlans, HoldForADiskWhoseLayersAreStreamed) {
  Show show = plain_show();
  show.camera.keys[0].r = 30.0;
  show.camera.keys[1].r = 29.0;
  show.camera.keys[0].theta = show.camera.keys[1].theta = 1.3;
  show.disk.emplace();
  const Projection projection = make_projection(show.view, show.view.size_px, 0.0);
  bake_to(show, folder_ / "t.trajectory", pixel_angle(projection));
  for (const bool eyes : {false, true}) {
    const auto stream = std::make_shared<StationStream>(Backend::cpu, TrajectoryReader(folder_ / "t.trajectory"),
                                                        StationStream::default_memory_bytes, [](const std::string&) {});
    const long all = static_cast<long>(stream->trajectory().stations().size());
    // Waits until all stations have been read. Otherwise, reading them ahead would count as work of
    // a picture.
    for (int tries = 0; tries < 500 && stream->statistics().read < all; ++tries) {
      stream->at(0.5, 1.0);
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    ASSERT_EQ(stream->statistics().read, all);
    if (eyes) {
      show.stereo.layout = StereoLayout::side_by_side;
      show.stereo.baseline = 0.05;
    }
    FrameRequest asked = request();
    asked.streamed = true;
    expect_as_planned(show, asked, stream);
    const FramePlan plan = plan_frame(show, asked);
    EXPECT_TRUE(plans(plan, disk_look_up_name(DiskDrawing::plain)));
    EXPECT_FALSE(plans(plan, "trace_disk_nodes"));
    EXPECT_EQ(plans(plan, "check_disk_grid"), eyes);
  }
}

TEST_F(FramePlans, HaveNoGridForADiskBesideAShellOrThatFalls) {
  FrameRequest asked = request();
  asked.lens = LensChoice::live;
  Show falls = plain_show();
  falls.disk.emplace();
  falls.disk->profile = DiskProfile::uniform;
  falls.disk->plunging = true;
  expect_as_planned(falls, asked);
  Show with_shell = plain_show();
  with_shell.disk.emplace();
  with_shell.shells.emplace_back();
  with_shell.shells[0].radius = 12.0;
  expect_as_planned(with_shell, asked);
  EXPECT_FALSE(plans(plan_frame(with_shell, asked), "trace_disk_nodes"));
  EXPECT_FALSE(plans(plan_frame(plain_show(), asked), "trace_disk_nodes"));
}

}  // namespace
}  // namespace ergodome
