#include "render/bake/trajectory_baker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <memory>

#include "content/camera/camera_path.h"
#include "content/trajectory/trajectory_journal.h"
#include "content/trajectory/trajectory_reader.h"
#include "kernels/core/angles.h"
#include "kernels/core/error.h"
#include "render/eyes/eye_camera.h"
#include "render/lens/stations/station_blend.h"
#include "tests/support/folder_test.h"
#include "tests/support/lens_errors.h"

namespace ergodome {
namespace {

//! Returns a show whose camera moves from r = 12, θ = 70° to r = 5 at the equator within ten
//! seconds, and stays there.
Show approach() {
  Show show;
  show.name = "approach";
  show.title = {{"", "Approach"}};
  show.duration_s = 12.0;
  show.spin = 0.999;
  show.camera.motion = ObserverMotion::geodesic;
  CameraKey far;
  far.r = 12.0;
  far.theta = 70.0 / 180.0 * pi;
  CameraKey near;
  near.time_s = 10.0;
  near.r = 5.0;
  near.phi = 6.0;
  show.camera.keys = {far, near};
  return show;
}

BakeSettings settings(bool derivatives = true) {
  BakeSettings settings;
  settings.derivatives = derivatives;
  settings.pixel = pi / (test::sanitized ? 256.0 : 2048.0);
  settings.budget_px = 0.25;
  return settings;
}

class TrajectoryBaker : public test::FolderTest {
 protected:
  [[nodiscard]] std::filesystem::path file(const std::string& name) const { return folder_ / name; }

  static std::string text_of(const std::filesystem::path& path) {
    std::ifstream from(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(from), {}};
  }

  //! Bakes a show to a finished trajectory file with the given name.
  BakeResult bake(const Show& show, const std::string& name, const BakeSettings& how = settings()) const {
    TrajectoryJournal journal(file(name + ".part"), provenance_of(show, how));
    BakeResult result = bake_trajectory(show, how, journal, [](double) { return true; });
    journal.seal(file(name), result.times_s);
    return result;
  }
};

//! Returns settings of a bake for pictures of 256 pixels.
BakeSettings coarse_settings() {
  BakeSettings how = settings();
  how.pixel = pi / 256.0;
  return how;
}

class TrajectoryBakerWith : public TrajectoryBaker, public testing::WithParamInterface<bool> {};

TEST_P(TrajectoryBakerWith, BlendsHoldTheBudgetAtAnyTimeOfTheShow) {
  if (test::sanitized) {
    GTEST_SKIP() << "bakes for minutes";
  }
  const Show show = approach();
  const BakeResult baked = bake(show, "whole", settings(GetParam()));
  EXPECT_EQ(baked.unmet, 0);
  EXPECT_LE(baked.worst_px, settings().budget_px);
  const TrajectoryReader reader(file("whole"));
  const auto buffers = [&](std::size_t i) { return std::make_shared<StationBuffers>(Backend::cpu, reader.read(i)); };
  for (const double time_s : {0.3, 2.9, 4.4, 5.3, 7.1, 9.2, 9.9}) {
    std::size_t next = 1;
    while (reader.stations()[next].time_s < time_s) {
      ++next;
    }
    const EyeCamera eye = eye_camera(show, camera_pose(show, time_s), 0.0);
    const StationBlend blend(Backend::cpu, buffers(next - 1), buffers(next), {eye.r, eye.theta});
    const test::Errors errors = test::screen_errors(
        blend.view(), make_camera_station(eye.spacetime, eye.r, eye.theta, 0.0, eye.motion, eye.velocity),
        aberration_to_rain(eye.spacetime, eye.r, eye.theta, eye.motion, eye.velocity), settings().pixel, 20'000);
    EXPECT_LE(errors.at(0.99), settings().budget_px) << time_s;
    EXPECT_LE(errors.at(0.999), 5.0 * settings().budget_px) << time_s;
  }
}

TEST_F(TrajectoryBaker, DividesAStretchAtWhoseEndACausticRunsThroughTheSamples) {
  // Near the spin axis, the image of the sky behind the hole is a ring. Tiny distances on the sky
  // are many pixels along this ring.
  Show show = approach();
  show.duration_s = 4.0;
  show.spin = 0.3;
  show.camera.motion = ObserverMotion::zamo;
  show.camera.keys[0].theta = 1.0 / 180.0 * pi;
  show.camera.keys[1].time_s = 4.0;
  show.camera.keys[1].r = 6.0;
  show.camera.keys[1].theta = 179.0 / 180.0 * pi;
  const BakeResult result = bake(show, "axis", coarse_settings());
  EXPECT_EQ(result.unmet, 0);
  EXPECT_LE(result.worst_px, settings().budget_px);
}

TEST_F(TrajectoryBaker, BuildsStationsFinerThatWouldMissTheBudgetByThemselves) {
  // A fast observer close to the hole sees a caustic ahead. A grid within the usual part of the
  // budget would have large errors in a thousandth of the sky, near that caustic.
  Show show = approach();
  show.duration_s = 1.0;
  show.spin = 0.7;
  show.camera.motion = ObserverMotion::velocity;
  show.camera.velocity = {0.17, 0.0, 0.68};
  show.camera.keys[0].r = 3.25;
  show.camera.keys[0].theta = 105.0 / 180.0 * pi;
  show.camera.keys[1].time_s = 1.0;
  show.camera.keys[1].r = 3.32;
  show.camera.keys[1].theta = 104.8 / 180.0 * pi;
  const BakeResult result = bake(show, "whirl", coarse_settings());
  EXPECT_EQ(result.unmet, 0);
}

INSTANTIATE_TEST_SUITE_P(Derivatives, TrajectoryBakerWith, testing::Bool(),
                         [](const testing::TestParamInfo<bool>& each) {
                           return each.param ? "WithDerivatives" : "WithoutDerivatives";
                         });

TEST_F(TrajectoryBaker, DerivativesNeedAFewOfTheStationsAndFewerBytes) {
  if (test::sanitized) {
    GTEST_SKIP() << "coarse stations are few in any case";
  }
  const Show show = approach();
  const std::size_t without = bake(show, "without", settings(false)).times_s.size();
  EXPECT_LT(2 * bake(show, "with").times_s.size(), without);
  EXPECT_LT(std::filesystem::file_size(file("with")), std::filesystem::file_size(file("without")));
}

TEST_F(TrajectoryBaker, ACameraThatStandsStillNeedsNoStationsButItsEnds) {
  Show show = approach();
  show.camera.keys[1].r = show.camera.keys[0].r;
  show.camera.keys[1].theta = show.camera.keys[0].theta;
  EXPECT_EQ(bake(show, "still").times_s, (std::vector<double>{0.0, 10.0, 12.0}));
  show.duration_s = 0.0;
  EXPECT_EQ(bake(show, "moment").times_s, std::vector<double>{0.0});
}

TEST_F(TrajectoryBaker, TellsThatAGridHasTheShadowBesideAnExtremalHorizonWrong) {
  Show show = approach();
  show.spin = 1.0;
  show.camera.motion = ObserverMotion::zamo;
  for (CameraKey& key : show.camera.keys) {
    key.r = 1.001;
    key.theta = 0.5 * pi;
  }
  const BakeResult result = bake(show, "horn", coarse_settings());
  EXPECT_GT(result.worst_px, 1.0);
  EXPECT_EQ(result.unmet, 2);
}

TEST_F(TrajectoryBaker, GivesUpNoMoreOfAnApproachToAnExtremalHorizonThanItsEnd) {
  Show show = approach();
  show.spin = 1.0;
  show.duration_s = 10.0;
  show.frame_rate_hz = 4.0;
  show.camera.motion = ObserverMotion::zamo;
  show.camera.keys[0].r = 6.0;
  show.camera.keys[1].r = 1.001;
  BakeSettings how = coarse_settings();
  how.derivatives = false;
  how.budget_px = 4.0;
  const BakeResult result = bake(show, "nearer", how);
  EXPECT_GT(result.unmet, 0);
  EXPECT_GT(result.worst_time_s, 7.5);
}

TEST_F(TrajectoryBaker, StoppedAndResumedAfterEveryGapTheBytesAreTheSame) {
  const Show show = approach();
  bake(show, "whole");
  for (int stops = 0;; ++stops) {
    ASSERT_LT(stops, 1000);
    TrajectoryJournal journal(file("resumed.part"), provenance_of(show, settings()));
    int gaps_left = stops;
    try {
      const BakeResult done = bake_trajectory(show, settings(), journal, [&](double) { return gaps_left-- > 0; });
      journal.seal(file("resumed"), done.times_s);
      break;
    } catch (const Error&) {
    }
  }
  EXPECT_EQ(text_of(file("resumed")), text_of(file("whole")));
}

TEST_F(TrajectoryBaker, PartsBakedApartAndJoinedAreTheSameBytes) {
  if (test::sanitized) {
    GTEST_SKIP() << "bakes for minutes";
  }
  const Show show = approach();
  bake(show, "whole");
  TrajectoryJournal joined(file("joined.part"), provenance_of(show, settings()));
  for (const int part : {3, 1, 2}) {
    BakeSettings mine = settings();
    mine.part = part;
    mine.parts = 3;
    TrajectoryJournal journal(file("part-" + std::to_string(part)), provenance_of(show, mine));
    bake_trajectory(show, mine, journal, [](double) { return true; });
    joined.absorb(journal);
  }
  const BakeResult rest = bake_trajectory(show, settings(), joined, [](double) { return true; });
  EXPECT_EQ(rest.built, 0);
  joined.seal(file("joined"), rest.times_s);
  EXPECT_EQ(text_of(file("joined")), text_of(file("whole")));
}

}  // namespace
}  // namespace ergodome
