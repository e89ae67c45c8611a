#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>

#include "content/camera/camera_path.h"
#include "kernels/core/angles.h"
#include "kernels/projection/pixel_measure.h"
#include "render/eyes/eye_camera.h"
#include "render/eyes/view_projection.h"
#include "render/frame/show_renderer.h"
#include "render/lens/stations/station_blend.h"
#include "tests/support/baked_show.h"
#include "tests/support/folder_test.h"
#include "tests/support/lens_errors.h"
#include "tests/support/sanitized.h"
#include "tests/support/tiny_sky.h"

namespace ergodome {
namespace {

//! Returns a show for small pictures. Its camera falls past the hole for two seconds, and then
//! moves away by camera keys.
Show falling_past() {
  return parse_show(
      "duration_s = 3\n[hole]\nspin = 0.7\n[camera]\n[camera.fall]\nclock = 8\nuntil_s = 2\nease_s = 0.5\n"
      "velocity = { beta = 0.7, toward = [-0.7, 0.1, 1] }\n[[camera.key]]\nr = 9\ntheta_deg = 70\nyaw_deg = 40\n"
      "[[camera.key]]\nt_s = 3\nr = 8\ntheta_deg = 80\nphi_deg = 200\nyaw_deg = 40\n"
      "[effects]\nredshift = true\n[view]\nsize_px = 48\n[quality]\nbudget_px = 0.5\n",
      "falling.toml");
}

//! A show with a fall, its trajectory file, and renderers of its frames.
class FallingBake : public test::FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    show_.sky.map = test::tiny_sky();
    const Projection projection = make_projection(show_.view, show_.view.size_px, 0.0);
    test::bake_to(show_, file(), pixel_angle(projection), true, show_.quality.budget_px);
  }

  [[nodiscard]] std::filesystem::path file() const { return folder_ / "falling.trajectory"; }

  [[nodiscard]] ShowRenderer streamed() const {
    return {show_, Backend::cpu, LensChoice::automatic,
            std::make_shared<StationStream>(Backend::cpu, TrajectoryReader(file()), StationStream::default_memory_bytes,
                                            [](const std::string&) {})};
  }

  Show show_ = falling_past();
};

Picture frame_at(ShowRenderer& renderer, double time_s) { return renderer.render(time_s, {}).front().picture; }

//! Compares each pixel of a picture with the same pixel and its neighbors in another picture.
//! Returns the fraction of pixels whose light is outside the range of those.
double displaced_part(const Picture& picture, const Picture& other) {
  constexpr float rounding = 1e-3F;
  const int size = other.width;
  int beyond = 0;
  int inside = 0;
  for (int y = 1; y + 1 < size; ++y) {
    for (int x = 1; x + 1 < size; ++x) {
      float minimum = INFINITY;
      float maximum = -INFINITY;
      for (int k = 0; k < 9; ++k) {
        const float light = other.rgba[4 * ((y + k / 3 - 1) * size + x + k % 3 - 1)];
        minimum = std::min(minimum, light);
        maximum = std::max(maximum, light);
      }
      const float light = picture.rgba[4 * (y * size + x)];
      inside += maximum > 0.0F ? 1 : 0;
      beyond += light < minimum - rounding || light > maximum + rounding ? 1 : 0;
    }
  }
  return static_cast<double>(beyond) / inside;
}

// Both lenses, streamed and live, are within half a pixel of the exact lens in 99 % of the sky. So
// in at least 98 %, they are within a pixel of each other, and each pixel's light is within the
// range of its neighbors in the other picture. Pixels on the edge of the shadow are an exception,
// because they contain the whole sky; they are another 2 %.
TEST_F(FallingBake, ShowsTheLivePictureInTheFallAndAfterIt) {
  ShowRenderer streaming = streamed();
  ShowRenderer live(show_, Backend::cpu, LensChoice::live);
  for (const double time_s : {0.9, 1.7, 2.3}) {
    const Picture picture = frame_at(streaming, time_s);
    ASSERT_STREQ(picture.lens, "streamed") << time_s;
    EXPECT_LT(displaced_part(picture, frame_at(live, time_s)), 0.04) << time_s;
  }
}

TEST_F(FallingBake, LooksOtherwiseToAnObserverWhoDoesNotFall) {
  ShowRenderer streaming = streamed();
  ShowRenderer live(show_, Backend::cpu, LensChoice::live);
  CameraPose pose = camera_pose(show_, 0.9);
  pose.velocity.reset();
  const Picture hovering =
      live.render_eye(pose, 0.0, make_projection(show_.view, show_.view.size_px, 0.0), ViewMode::sky);
  EXPECT_GT(displaced_part(frame_at(streaming, 0.9), hovering), 0.2);
}

TEST_F(FallingBake, GivesAFrameTheSamePictureAloneAndInASequence) {
  ShowRenderer sequence = streamed();
  Picture last;
  for (const double time_s : {0.3, 1.2, 2.9, 0.0, 1.6, 1.7}) {
    last = frame_at(sequence, time_s);
  }
  ShowRenderer alone = streamed();
  EXPECT_EQ(frame_at(alone, 1.7).rgba, last.rgba);
}

//! Returns a show whose camera is released at high speed. It falls for two seconds and is then at
//! rest.
Show let_go() {
  return parse_show(
      "duration_s = 6\n[hole]\nspin = 0.7\n[camera]\nobserver = \"zamo\"\n[camera.fall]\nt_s = 2\nclock = 1\n"
      "until_s = 4\nvelocity = { beta = 0.99, toward = [-1, 0.1, 0] }\n[[camera.key]]\nr = 9\ntheta_deg = 70\n"
      "[[camera.key]]\nt_s = 2\nr = 9\ntheta_deg = 70\n",
      "let-go.toml");
}

//! Returns the error on the screen [px] of the blend of two baked stations at a time. In 99 % of
//! the sky, the error is at most this.
double missed_px(const Show& show, const TrajectoryReader& baked, double time_s, double pixel) {
  const auto buffers = [&](std::size_t i) { return std::make_shared<StationBuffers>(Backend::cpu, baked.read(i)); };
  std::size_t next = 1;
  while (baked.stations()[next].time_s < time_s) {
    ++next;
  }
  const EyeCamera eye = eye_camera(show, camera_pose(show, time_s), 0.0);
  const StationBlend blend(Backend::cpu, buffers(next - 1), buffers(next), {eye.r, eye.theta});
  // Under sanitizers, screen_errors() uses only a fiftieth of the requested rays, and 100 rays
  // would be too few for a 99th percentile.
  constexpr std::size_t rays = test::sanitized ? 100'000 : 5'000;
  return test::screen_errors(blend.view(),
                             make_camera_station(eye.spacetime, eye.r, eye.theta, 0.0, eye.motion, eye.velocity),
                             aberration_to_rain(eye.spacetime, eye.r, eye.theta, eye.motion, eye.velocity), pixel, rays)
      .at(0.99);
}

class LetGoBake : public test::FolderTest {};

// A fast observer sees the sky behind it compressed, so a grid for that observer is coarse there.
// An observer at rest needs a fine grid in the same directions.
TEST_F(LetGoBake, HoldsTheBudgetWhereTheCameraStandsWhileItsVelocityGoesOver) {
  const Show show = let_go();
  constexpr double budget_px = 0.25;
  constexpr double pixel = pi / 512.0;
  const std::filesystem::path file = folder_ / "let-go.trajectory";
  test::bake_to(show, file, pixel, true, budget_px);
  const TrajectoryReader baked(file);
  for (const double time_s : {1.7, 4.6, 4.9, 5.5}) {
    EXPECT_LT(missed_px(show, baked, time_s, pixel), budget_px) << time_s;
  }
}

//! Returns a show whose camera falls through the horizon of a hole with spin 0.6, at 1.8 M, in the
//! rain frame.
Show falling_through() {
  return parse_show(
      "duration_s = 2\n[hole]\nspin = 0.6\n[camera.fall]\nvelocity = \"rain\"\nclock = 1\nease_s = 0.2\nleast_r = 0.9\n"
      "[[camera.key]]\nr = 2.2\ntheta_deg = 78\n",
      "through.toml");
}

//! The trajectory file of a fall through the horizon.
class BakeThroughTheHorizon : public test::FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    test::bake_to(show_, file(), pixel, true, budget_px);
  }

  [[nodiscard]] std::filesystem::path file() const { return folder_ / "through.trajectory"; }

  static constexpr double budget_px = 0.25;
  static constexpr double pixel = pi / 512.0;
  Show show_ = falling_through();
};

TEST_F(BakeThroughTheHorizon, HoldsTheBudgetOnBothSidesAndWhereItGoesThrough) {
  const TrajectoryReader baked(file());
  const double horizon_s = *show_.camera.orbit->horizon_s();
  for (const double time_s : {0.5 * horizon_s, horizon_s - 1e-3, horizon_s + 1e-3, horizon_s + 0.4, 1.9}) {
    EXPECT_LT(missed_px(show_, baked, time_s, pixel), budget_px) << time_s;
  }
}

TEST_F(BakeThroughTheHorizon, NeedsNoStationWhereItGoesThrough) {
  const double horizon_s = *show_.camera.orbit->horizon_s();
  const TrajectoryReader baked(file());
  for (const StationEntry& station : baked.stations()) {
    EXPECT_GT(std::abs(station.time_s - horizon_s), 1e-3);
  }
}

TEST_F(BakeThroughTheHorizon, IsAFileThatProgramsWhichKnowOfNoneWithinRefuse) {
  std::ifstream bytes(file(), std::ios::binary);
  bytes.seekg(8);
  EXPECT_EQ(bytes.get(), 2);
}

}  // namespace
}  // namespace ergodome
