#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/app/navigation/test_flights.h"

namespace ergodome {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): flights of tests

//! Result of a test flight that follows the path, leaves it, flies freely, and returns to it: the
//! largest changes, from one frame to the next, of the rate at which the position (relative to r)
//! and the view change.
struct Journey {
  double position_change = 0.0;
  double view_change = 0.0;
  double time_back_s = 0.0;
  double end_error = 0.0;
};

Journey journey(const Show& show, const Steering& away, double away_s) {
  Navigator navigator(show);
  double time_s = 20.0;
  CameraPlacement last;
  glm::dvec3 way{0.0};
  glm::dvec3 turn{0.0};
  Journey journey;
  int frame = 0;
  const auto play = [&](const Steering& steering) {
    time_s += frame_s;
    navigator.advance(frame_s, holding(steering), camera_pose(show, time_s));
    const CameraPlacement now = placement_of(navigator.pose());
    const glm::dvec3 new_way = (now.r * now.towards - last.r * last.towards) / (now.r * frame_s);
    const glm::dvec3 new_turn = turn_of(now.view * glm::conjugate(last.view)) / frame_s;
    if (frame++ > 1) {
      journey.position_change = std::max(journey.position_change, glm::distance(new_way, way));
      journey.view_change = std::max(journey.view_change, glm::distance(new_turn, turn));
    }
    last = now;
    way = new_way;
    turn = new_turn;
  };
  while (time_s < 21.0) {
    play({});
  }
  navigator.leave_path();
  const double left_s = time_s;
  while (time_s < left_s + away_s) {
    play(away);
  }
  navigator.return_to_path();
  const double returned_s = time_s;
  while (navigator.course() != Navigator::Course::path && time_s < 95.0) {
    play({});
  }
  journey.time_back_s = time_s - returned_s;
  const CameraPlacement path = placement_of(camera_pose(show, time_s));
  journey.end_error = glm::distance(path.r * path.towards, last.r * last.towards) + angle_between(path.view, last.view);
  return journey;
}

TEST(PathReturn, BeginsAndEndsWithTheSameVelocityAndArrivesInTime) {
  for (const Steering& away :
       {Steering{}, Steering{1.0, 0.0, -1.0}, Steering{0.0, 1.0, 1.0, 0.5, 0.2}, Steering{-1.0, -1.0, 0.4, -1.0}}) {
    const Journey back = journey(moving_show(), away, 4.0);
    // A jump would change the rate by about 0.3 per second, which is the rate itself. The limits on
    // acceleration and the blend with the path allow far less per frame.
    EXPECT_LT(back.position_change, 0.05);
    EXPECT_LT(back.view_change, 0.05);
    EXPECT_LT(back.time_back_s, 12.0);
    EXPECT_LT(back.end_error, 1e-9);
  }
}

TEST(PathReturn, NeverGoesThroughTheGuard) {
  const Show show = moving_show();
  Navigator navigator(show);
  double time_s = 0.0;
  const auto play = [&](const Steering& steering) {
    time_s += frame_s;
    navigator.advance(frame_s, holding(steering), camera_pose(show, time_s));
    ASSERT_GT(navigator.pose().r, navigator.space().guard_r());
  };
  play({});
  navigator.leave_path();
  for (int i = 0; i < 600; ++i) {
    play(forward_only(1.0));
  }
  navigator.return_to_path();
  for (int i = 0; i < 2000; ++i) {
    play({});
  }
  EXPECT_EQ(navigator.course(), Navigator::Course::path);
}

TEST(PathReturn, TakesASeekOfTheShowMeanwhile) {
  const Show show = moving_show();
  Navigator navigator(show);
  navigator.advance(frame_s, {}, camera_pose(show, 1.0));
  navigator.leave_path();
  for (int i = 0; i < 200; ++i) {
    navigator.advance(frame_s, holding({1.0}), camera_pose(show, 1.0));
  }
  navigator.return_to_path();
  CameraPlacement last = placement_of(navigator.pose());
  for (int i = 0; i < 600; ++i) {
    navigator.advance(frame_s, {}, camera_pose(show, i < 60 ? 1.0 : 80.0));
    const CameraPlacement now = placement_of(navigator.pose());
    ASSERT_LT(glm::distance(now.r * now.towards, last.r * last.towards), 0.3);
    last = now;
  }
  EXPECT_NEAR(navigator.pose().r, camera_pose(show, 80.0).r, 1e-12);
}

}  // namespace
}  // namespace ergodome
