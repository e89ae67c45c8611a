#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "app/navigation/controls/controls.h"
#include "app/player/player_session.h"
#include "content/camera/rain_pose.h"
#include "content/camera/within.h"
#include "content/show/reading/show_reader.h"
#include "render/eyes/eye_camera.h"

namespace ergodome {
namespace {

using testing::HasSubstr;

constexpr double session_spin = 0.9;

//! A visitor's session in free flight, with a clock that the test sets.
class VisitorSession : public testing::Test {
 protected:
  VisitorSession()
      : session_(parse_show("duration_s = 9\n[hole]\nspin = 0.9\n[[camera.key]]\nr = 4\ntheta_deg = 70\n[stereo]\n"
                            "layout = \"side_by_side\"\nbaseline = 0.05\n"
                            "[[chapter]]\nt_s = 0\ntitle = { en = \"A\", de = \"B\" }\n",
                            "visit.toml"),
                 {.free_flight = true, .language = "en", .source = [this] { return now_; }}) {
    run(0.1);
  }

  void run(double seconds, const PlayerInput& input = {}) {
    for (int i = 0; i < std::lround(60.0 * seconds); ++i) {
      now_ += std::chrono::nanoseconds(16'666'667);
      session_.advance(input);
    }
  }
  void press(KeyAction action) {
    PlayerInput input;
    input.actions = {action};
    run(1.0 / 60.0, input);
  }
  [[nodiscard]] bool within() const { return session_.frame().pose.r < horizon_radius(Spacetime{session_spin}); }
  void fall_within() {
    press(KeyAction::let_go);
    for (int i = 0; i < 3000 && !within(); ++i) {
      run(1.0 / 60.0);
    }
    ASSERT_TRUE(within());
  }

  MonotonicTime now_ = std::chrono::seconds(1000);
  PlayerSession session_;
};

TEST_F(VisitorSession, FallsThroughTheHorizonBelowTheTriggerOfAPad) {
  PadState pressed;
  pressed.buttons.set(static_cast<std::size_t>(PadButton::left_trigger));
  PlayerInput input;
  input.actions = Controls().pressed(PadState(), pressed);
  run(1.0 / 60.0, input);
  run(40.0);
  EXPECT_LT(session_.frame().pose.r, 0.9 * horizon_radius(Spacetime{session_spin}));
  EXPECT_THAT(session_.caption(), HasSubstr("inside the horizon"));
}

TEST_F(VisitorSession, SaysWhereOneIsInGermanToo) {
  session_.playback().apply({TransportCommand::Kind::language, 0.0, "de"});
  fall_within();
  EXPECT_THAT(session_.frame().observer.sentence, HasSubstr("innerhalb des Horizonts"));
}

//! Returns the velocity of the frame's observer in the rain frame.
Vector3<double> in_rain(const PlayerFrame& frame) {
  CameraPose pose = frame.pose;
  if (!pose.velocity) {
    pose.velocity =
        observer_velocity(frame.observer.motion, Spacetime{session_spin}, pose.r, pose.theta, frame.observer.velocity);
  }
  return *in_rain_frame(pose, Spacetime{session_spin}).velocity;
}

TEST_F(VisitorSession, AnotherObserverGoesOverIntoWhoFallsWithoutALeap) {
  press(KeyAction::let_go);
  run(2.0);
  press(KeyAction::next_observer);
  run(2.0);
  ASSERT_FALSE(session_.frame().pose.velocity_in_rain);
  Vector3<double> before = in_rain(session_.frame());
  for (int i = 0; i < 3000 && session_.frame().pose.r > 0.9 * horizon_radius(Spacetime{session_spin}); ++i) {
    run(1.0 / 60.0);
    const Vector3<double> now = in_rain(session_.frame());
    const Vector3<double> change = now - before;
    ASSERT_LT(dot(change, change), 0.03 * 0.03) << session_.frame().pose.r;
    before = now;
  }
  EXPECT_TRUE(within());
}

TEST_F(VisitorSession, SeesWithEyesOfAModelThatIsKnownWithin) {
  press(KeyAction::next_model);
  ASSERT_EQ(session_.frame().stereo.model, StereoModel::flat);
  fall_within();
  EXPECT_EQ(session_.frame().stereo.model, StereoModel::physical);
  press(KeyAction::next_model);
  EXPECT_EQ(session_.frame().stereo.model, StereoModel::omni);
}

TEST_F(VisitorSession, KeepsTheModelOfEyesThatWasChosenBeforeAFall) {
  press(KeyAction::next_model);
  fall_within();
  press(KeyAction::baseline_larger);
  press(KeyAction::return_to_path);
  EXPECT_EQ(session_.frame().stereo.model, StereoModel::flat);
}

TEST_F(VisitorSession, TellsThatTheShowsOwnFlatEyesAreReplacedInAFall) {
  PlayerSession session(parse_show("[hole]\nspin = 0.9\n[[camera.key]]\nr = 4\n[stereo]\nlayout = \"side_by_side\"\n"
                                   "model = \"flat\"\nbaseline = 0.05\n",
                                   "flat.toml"),
                        {.free_flight = true, .language = "en", .source = [this] { return now_; }});
  session.advance({});
  ASSERT_EQ(session.frame().stereo.model, StereoModel::flat);
  PlayerInput input;
  input.actions = {KeyAction::let_go};
  now_ += std::chrono::milliseconds(17);
  session.advance(input);
  EXPECT_THAT(session.caption(), testing::HasSubstr("Stereo model flat is not possible in a fall"));
  for (int i = 0; i < 3000 && session.frame().pose.r > horizon_radius(Spacetime{session_spin}); ++i) {
    now_ += std::chrono::milliseconds(17);
    session.advance({});
  }
  EXPECT_LT(session.frame().pose.r, horizon_radius(Spacetime{session_spin}));
  EXPECT_EQ(session.frame().stereo.model, StereoModel::physical);
}

TEST_F(VisitorSession, ComesBackToTheShowFromWithin) {
  fall_within();
  press(KeyAction::return_to_path);
  EXPECT_FALSE(session_.flying());
  EXPECT_NEAR(session_.frame().pose.r, 4.0, 1e-9);
}

TEST_F(VisitorSession, AnyKeysAtAnyTimeLeaveACameraThatCanBeShown) {
  Show show = parse_show(
      "duration_s = 12\n[hole]\nspin = 0.9\n[camera.fall]\nclock = 1.5\nease_s = 0.5\nleast_r = 0.6\n"
      "velocity = { beta = 0.4, toward = [-1, 0.4, 0.7] }\n[[camera.key]]\nr = 5\ntheta_deg = 70\n",
      "keys.toml");
  PlayerSession session(show, {.free_flight = false, .language = "en", .source = [this] { return now_; }});
  std::mt19937 random(5);
  bool went_in = false;
  for (int i = 0; i < 20'000; ++i) {
    constexpr int steps_ms[] = {0, 1, 16, 16, 16, 60, 2000, -3000};
    now_ += std::chrono::milliseconds(steps_ms[random() % 8]);
    PlayerInput input;
    if (random() % 6 == 0) {
      input.actions = {random() % 4 == 0 ? KeyAction::let_go : all_actions()[random() % all_actions().size()].action};
    }
    input.steering.rates.yaw = random() % 3 == 0 ? 1.0 : 0.0;
    input.steering.rates.forward = random() % 9 == 0 ? -1.0 : 0.0;
    session.advance(input);
    const PlayerFrame& frame = session.frame();
    show.camera.motion = frame.observer.motion;
    show.camera.velocity = frame.observer.velocity;
    const EyeCamera eye = eye_camera(show, frame.pose, 0.01);
    ASSERT_TRUE(dot(eye.velocity, eye.velocity) < 1.0) << i << ' ' << frame.pose.r;
    went_in = went_in || (session.flying() && frame.pose.r < horizon_radius(Spacetime{session_spin}));
  }
  EXPECT_TRUE(went_in);
}

}  // namespace
}  // namespace ergodome
