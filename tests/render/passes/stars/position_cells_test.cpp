#include "render/passes/stars/position_cells.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <optional>
#include <thread>

#include "kernels/spacetime/kerr/kerr.h"
#include "render/passes/stars/camera_course.h"
#include "tests/render/passes/stars/star_cameras.h"

namespace ergodome {
namespace {

using test::eye_at_position;

EyePicture picture_at(const LensPosition& here, const ShowMoment& moment, const Show* show = nullptr) {
  EyePicture picture;
  picture.eye = eye_at_position({0.9, here.r, here.theta, 0.0, ObserverMotion::zamo});
  picture.settings.moment = moment;
  picture.settings.show = show;
  return picture;
}

CameraCourse course_from(const LensPosition& before, const LensPosition& here) {
  return course_of(picture_at(here, {std::nullopt, 0.0, before}));
}

TEST(CameraCourseOfAFlight, IsSlowIfTheCameraMovesLittle) {
  EXPECT_TRUE(course_from({8.0, 1.3}, {7.995, 1.3}).slow);
  EXPECT_TRUE(course_from({8.0, 1.3}, {8.0, 1.301}).slow);
  EXPECT_FALSE(course_from({8.0, 1.3}, {8.0, 1.3}).slow) << "it stands";
  EXPECT_FALSE(course_from({8.0, 1.3}, {7.5, 1.3}).slow) << "it crosses several cells";
  EXPECT_TRUE(course_from({8.0, 1.3}, {7.95, 1.3}).slow) << "it crosses a quarter of a cell along r";
  EXPECT_FALSE(course_from({8.0, 1.3}, {8.0, 1.303}).slow) << "it crosses two fifths of a cell along the polar angle";
  EXPECT_FALSE(course_of(picture_at({8.0, 1.3}, {})).slow) << "nothing is known of it";
}

TEST(CameraCourseOfAFlight, HasTheStepFromThePictureBefore) {
  const CameraCourse course = course_from({8.0, 1.3}, {7.995, 1.301});
  ASSERT_TRUE(course.step);
  EXPECT_NEAR(course.step->r, -0.005, 1e-12);
  EXPECT_NEAR(course.step->theta, 0.001, 1e-12);
}

TEST(CameraCourseOfAFlight, IsNotSlowForObserversOfAnyVelocity) {
  EyePicture picture = picture_at({7.995, 1.3}, {std::nullopt, 0.0, LensPosition{8.0, 1.3}});
  picture.eye.motion = ObserverMotion::velocity;
  EXPECT_FALSE(course_of(picture).slow);
}

TEST(CameraCourseOfAPath, DependsOnTheShowAndNotOnThePictureBefore) {
  Show show;
  show.spin = 0.9;
  show.duration_s = 30.0;
  show.camera.keys.resize(3);
  show.camera.keys[0].r = 8.0;
  show.camera.keys[1].time_s = 10.0;
  show.camera.keys[1].r = 8.0;
  show.camera.keys[2].time_s = 30.0;
  show.camera.keys[2].r = 7.0;
  for (const bool far : {false, true}) {
    const LensPosition before = {far ? 20.0 : 8.0, 1.3};
    EXPECT_TRUE(course_of(picture_at({7.5, 1.3}, {20.0, 0.0, before}, &show)).slow);
    EXPECT_FALSE(course_of(picture_at({8.0, 1.3}, {3.0, 0.0, before}, &show)).slow);
  }
}

//! Builds cells and counts them, by whether this or another thread builds them.
struct Builds {
  std::atomic<int> here{0};
  std::atomic<int> elsewhere{0};
  std::thread::id thread = std::this_thread::get_id();

  PositionCells::Build build() {
    return [this](const StarEye& middle, const StarSettings& asked, MotionRoom& room) {
      ++(std::this_thread::get_id() == thread ? here : elsewhere);
      LensStation station = build_moving_station(middle.camera, asked);
      StarPatches patches = star_patches(field, test::colours().view(), middle, station, asked, room.patches);
      return MovingPatches(std::move(station), std::move(patches), room);
    };
  }

  StarField field{test::brightest(100), glm::dmat3(1.0), test::colours().view()};
};

TEST(PositionCellsOfAMovingCamera, AreBuiltBeforeTheyAreEntered) {
  Builds builds;
  PositionCells cells(builds.build());
  StarSettings asked;
  asked.course = {true, LensPosition{-0.04, 0.0}};
  asked.pixel = pi / 1024;
  const double horizon = horizon_radius(Spacetime{0.9});
  StarEye eye(eye_at_position({0.9, 8.0, 1.3, 0.0, ObserverMotion::zamo}));
  int entered = 0;
  std::optional<StarEye> last;
  for (int picture = 0; picture < 30; ++picture) {
    const std::optional<StarEye> middle = cell_of(eye, asked.course);
    ASSERT_TRUE(middle);
    entered += last && served_alike(*last, *middle) ? 0 : 1;
    last = middle;
    cells.prepare_next(eye, asked);
    const MovingPatches& patches = cells.patches(*middle, asked);
    const LensStation there = patches.station_at({eye.camera.r, eye.camera.theta});
    EXPECT_NEAR(std::log((there.r - horizon) / (middle->camera.r - horizon)), 0.0, 0.501 * position_cell_height);
    eye.camera.r = eye.camera.head_r = eye.camera.r + asked.course.step->r;
  }
  cells.wait();
  EXPECT_GT(entered, 4);
  EXPECT_EQ(builds.here, 1);
  EXPECT_GE(builds.elsewhere, entered - 1);
  EXPECT_LE(builds.elsewhere, entered);
}

TEST(PositionCellsOfAMovingCamera, AreNotPreparedForAnUnknownStep) {
  Builds builds;
  PositionCells cells(builds.build());
  StarSettings asked;
  asked.course = {true};
  const StarEye eye(eye_at_position({0.9, 8.0, 1.3, 0.0, ObserverMotion::zamo}));
  cells.prepare_next(eye, asked);
  cells.patches(*cell_of(eye, asked.course), asked);
  cells.patches(*cell_of(eye, asked.course), asked);
  cells.wait();
  EXPECT_EQ(builds.here, 1);
  EXPECT_EQ(builds.elsewhere, 0);
}

}  // namespace
}  // namespace ergodome
