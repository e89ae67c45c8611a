// Tests that record flights through the horizon: the saved show, when it is read back, must repeat
// the flight.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "app/player/player_session.h"
#include "content/camera/rain_pose.h"
#include "content/show/reading/show_reader.h"

namespace ergodome {
namespace {

using testing::HasSubstr;

constexpr double record_spin = 0.9;
const std::string standing = "duration_s = 9\n[hole]\nspin = 0.9\n[[camera.key]]\nr = 4\ntheta_deg = 70\n";
const std::string falling =
    "duration_s = 12\n[hole]\nspin = 0.9\n[camera.fall]\nclock = 1.5\nease_s = 0.5\nleast_r = 0.6\n"
    "velocity = { beta = 0.4, toward = [-1, 0.4, 0.7] }\n[[camera.key]]\nr = 5\ntheta_deg = 70\n";

//! A session with a clock that the test sets; keeps the frames at the sample times of the
//! recording.
class RecordedFlight : public testing::Test {
 protected:
  void open(const std::string& show, bool free_flight) {
    session_.emplace(parse_show(show, "flown.toml"),
                     SessionOptions{.free_flight = free_flight, .language = "en", .source = [this] { return now_; }});
    frame();
  }
  void frame(const PlayerInput& input = {}) {
    now_ += std::chrono::nanoseconds(16'666'667);
    session_->advance(input);
  }
  void press(KeyAction action) {
    PlayerInput input;
    input.actions = {action};
    frame(input);
  }
  void record() {
    session_->record();
    begin_s_ = session_->now_s() + 1.0 / 60.0;
  }
  //! Continues the flight while `goes` returns true for its pose. Advances by two frames at a time
  //! and keeps the first of each two.
  template <class Goes>
  void fly_while(const Goes& goes, double yaw = 0.0) {
    PlayerInput input;
    input.steering.rates.yaw = yaw;
    for (int i = 0; i < 3000 && goes(session_->frame().pose); ++i) {
      frame(input);
      flown_.push_back(session_->frame());
      times_s_.push_back(session_->now_s() - begin_s_);
      frame(input);
    }
  }
  void fly_to(double r, double yaw = 0.0) {
    fly_while([r](const CameraPose& pose) { return pose.r > r; }, yaw);
  }
  [[nodiscard]] Show read_again() const {
    return parse_show(to_toml(session_->recorded("A flight").value()), "r.toml");
  }
  [[nodiscard]] static bool within(const CameraPose& pose) {
    return !(pose.r > horizon_radius(Spacetime{record_spin}));
  }

  //! Returns the pose of a recorded frame with its velocity, converted to the frame (rain or ZAMO)
  //! in which the velocity of `other` is given.
  [[nodiscard]] static CameraPose in_frame_of(const CameraPose& other, const PlayerFrame& flown) {
    CameraPose pose = flown.pose;
    if (!pose.velocity) {
      pose.velocity =
          observer_velocity(flown.observer.motion, Spacetime{record_spin}, pose.r, pose.theta, flown.observer.velocity);
    }
    return other.velocity_in_rain ? in_rain_frame(pose, Spacetime{record_spin})
                                  : in_zamo_frame(pose, Spacetime{record_spin});
  }

  //! Expects that the recorded flight, from `from_s` on, agrees with the show. At the same point of
  //! the flight, the show's time is larger by `later_s`.
  void expect_shown(const Show& show, double from_s = 0.0, double later_s = 0.0) const {
    for (std::size_t i = 0; i < flown_.size(); ++i) {
      if (times_s_[i] < from_s) {
        continue;
      }
      const CameraPose is = camera_pose(show, times_s_[i] + later_s);
      const CameraPose was = in_frame_of(is, flown_[i]);
      const bool on_orbit = is.velocity_in_rain;
      ASSERT_NEAR(is.r, was.r, on_orbit ? 1e-6 : 1.01e-3 * was.r) << times_s_[i];
      ASSERT_NEAR(is.theta, was.theta, on_orbit ? 1e-6 : 1.01e-3) << times_s_[i];
      ASSERT_NEAR(std::remainder(is.phi - was.phi, 2.0 * std::acos(-1.0)), 0.0, on_orbit ? 1e-6 : 2e-3) << times_s_[i];
      ASSERT_GT(std::abs(glm::dot(is.orientation, was.orientation)), std::cos(0.5 * 1.02e-3)) << times_s_[i];
      const Vector3<double> moves = is.velocity.value_or(*was.velocity) - *was.velocity;
      ASSERT_LT(std::sqrt(dot(moves, moves)), on_orbit ? 1e-6 : 2e-3) << times_s_[i];
    }
  }

  MonotonicTime now_ = std::chrono::seconds(1000);
  std::optional<PlayerSession> session_;
  std::vector<PlayerFrame> flown_;
  std::vector<double> times_s_;
  double begin_s_ = 0.0;
};

TEST_F(RecordedFlight, ShowsAFallOnBothSidesOfTheHorizonWithTheLooksOnTheWay) {
  open(standing, true);
  record();
  int frames = 0;
  fly_while([&](const CameraPose& /*pose*/) { return ++frames < 15; }, 0.5);
  press(KeyAction::let_go);
  frame();
  fly_to(2.0, -0.6);
  fly_to(0.7, 0.8);
  const Show show = read_again();
  ASSERT_TRUE(within(camera_pose(show, show.duration_s)));
  EXPECT_GT(show.camera.fall->time_s, 0.4);
  expect_shown(show);
}

TEST_F(RecordedFlight, ShowsARestAtTheDeepestPlace) {
  open(standing, true);
  press(KeyAction::let_go);
  record();
  int frames = 0;
  fly_while([&](const CameraPose& /*pose*/) { return ++frames < 1500; });
  const Show show = read_again();
  EXPECT_NEAR(show.duration_s, 50.0, 0.2);
  expect_shown(show);
}

TEST_F(RecordedFlight, BeginsWithinTheHorizonAtAPlaceOfTheSameOrbitOutside) {
  open(falling, false);
  while (!within(session_->frame().pose)) {
    frame();
  }
  press(KeyAction::let_go);
  record();
  fly_to(0.7, 0.4);
  const Show show = read_again();
  EXPECT_FALSE(within(camera_pose(show, 0.0)));
  expect_shown(show, 0.0, show.duration_s - times_s_.back());
}

TEST_F(RecordedFlight, GoesOnWhereTheFallIsTakenFromAShow) {
  open(falling, false);
  record();
  fly_to(3.0);
  press(KeyAction::let_go);
  frame();
  fly_to(0.7, 0.4);
  const Show show = read_again();
  ASSERT_TRUE(within(camera_pose(show, show.duration_s)));
  expect_shown(show);
}

TEST_F(RecordedFlight, ShowsWhatAnotherObserverSawOnTheWay) {
  open(standing, true);
  press(KeyAction::let_go);
  press(KeyAction::next_observer);
  record();
  fly_to(0.9);
  const Show show = read_again();
  ASSERT_TRUE(within(camera_pose(show, show.duration_s)));
  EXPECT_LT(camera_pose(show, show.camera.fall->time_s).r, 1.31 * horizon_radius(Spacetime{record_spin}));
  expect_shown(show, 0.5);
}

TEST_F(RecordedFlight, EndsWithTheFallAndSaysSo) {
  open(standing, true);
  press(KeyAction::let_go);
  record();
  fly_to(1.0);
  press(KeyAction::return_to_path);
  EXPECT_THAT(session_->caption(), HasSubstr("recording ends"));
  const double end_s = session_->now_s() - begin_s_;
  fly_while([&](const CameraPose& /*pose*/) { return times_s_.back() < end_s + 1.0; });
  const Show show = read_again();
  EXPECT_TRUE(within(camera_pose(show, show.duration_s)));
  EXPECT_LT(show.duration_s, end_s + 0.05);
}

TEST_F(RecordedFlight, EndsWhereTheShowFallsWithinOnAnotherOrbitAndSaysSo) {
  open(falling, false);
  record();
  fly_to(2.4);
  int frames = 0;
  fly_while([&](const CameraPose& /*pose*/) { return ++frames < 30; }, 0.5);
  press(KeyAction::let_go);
  frame();
  fly_to(1.0);
  const double end_s = session_->now_s() - begin_s_;
  press(KeyAction::return_to_path);
  ASSERT_TRUE(within(session_->frame().pose));
  EXPECT_THAT(session_->caption(), HasSubstr("recording ends"));
  const Show show = read_again();
  EXPECT_TRUE(within(camera_pose(show, show.duration_s)));
  EXPECT_LT(show.duration_s, end_s + 0.05);
}

TEST_F(RecordedFlight, IsOfTheHoleThatWasFallenIntoWhateverSpinTheShowGetsLater) {
  open(standing, true);
  press(KeyAction::let_go);
  record();
  fly_to(1.0);
  session_->set_show(parse_show("duration_s = 9\n[hole]\nspin = 0.2\n[[camera.key]]\nr = 4\n", "flown.toml"));
  EXPECT_THAT(session_->caption(), HasSubstr("recording ends"));
  frame();
  const Show show = read_again();
  EXPECT_EQ(show.spin, record_spin);
  ASSERT_TRUE(within(camera_pose(show, show.duration_s)));
  expect_shown(show);
}

TEST_F(RecordedFlight, GoesOnWhereTheShowIsReadAgainWithTheSameFall) {
  open(falling, false);
  record();
  fly_to(1.0);
  session_->set_show(parse_show(falling, "flown.toml"));
  fly_to(0.8);
  const Show show = read_again();
  EXPECT_LT(camera_pose(show, show.duration_s).r, 0.85);
  expect_shown(show);
}

TEST_F(RecordedFlight, HasKeysAloneWhereAFallWasLeftOutside) {
  open(standing, true);
  press(KeyAction::let_go);
  record();
  fly_to(1.8);
  press(KeyAction::next_flight_mode);
  frame();
  int frames = 0;
  fly_while([&](const CameraPose& /*pose*/) { return ++frames < 30; });
  const Show show = read_again();
  EXPECT_FALSE(show.camera.fall.has_value());
  expect_shown(show);
}

TEST_F(RecordedFlight, HasEyesThatSeeWithinTheHorizon) {
  open(standing + "[stereo]\nlayout = \"side_by_side\"\nbaseline = 0.05\n", true);
  press(KeyAction::next_model);
  press(KeyAction::let_go);
  record();
  fly_to(0.9);
  EXPECT_EQ(read_again().stereo.model, StereoModel::physical);
}

}  // namespace
}  // namespace ergodome
