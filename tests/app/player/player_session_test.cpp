#include "app/player/player_session.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/cli/show_loading.h"
#include "content/show/reading/show_reader.h"

namespace ergodome {
namespace {

constexpr const char* orbiting_show = R"(
title = "Orbit"
duration_s = 10
[hole]
spin = 0.9
[camera]
[[camera.key]]
t_s = 0
r = 12
[[camera.key]]
t_s = 10
r = 8
phi_deg = 90
[stereo]
layout = "side_by_side"
baseline = 0.1
[[animate]]
number = "stereo.baseline"
key = [{ t_s = 0, value = 0.1, ease = "linear" }, { t_s = 10, value = 1.1 }]
[[chapter]]
t_s = 0
title = { en = "One", de = "Eins" }
[[chapter]]
t_s = 5
title = { en = "Two", de = "Zwei" }
)";

//! A session with a clock that the test sets.
class PlayerSessionTest : public testing::Test {
 protected:
  PlayerSession session_on(const std::string& text, bool free_flight = false) {
    return {parse_show(text, "orbit.toml"),
            {.free_flight = free_flight, .language = "en", .source = [this] { return now_; }}};
  }

  //! Advances the session in frames of 1/60 s.
  void run(PlayerSession& session, double seconds, const PlayerInput& input = {}) {
    const int frames = static_cast<int>(std::lround(60.0 * seconds));
    for (int i = 0; i < frames; ++i) {
      now_ += std::chrono::nanoseconds(16'666'667);
      session.advance(input);
    }
  }

  static PlayerInput pressing(KeyAction action) {
    PlayerInput input;
    input.actions = {action};
    return input;
  }

  MonotonicTime now_ = std::chrono::seconds(1000);
};

TEST_F(PlayerSessionTest, FollowsTheShowsPath) {
  PlayerSession session = session_on(orbiting_show);
  run(session, 5.0);
  EXPECT_NEAR(session.frame().time_s, 5.0, 1e-5);
  EXPECT_DOUBLE_EQ(session.frame().pose.r, camera_pose(session.show(), session.frame().time_s).r);
  EXPECT_EQ(session.frame().path_time_s, session.frame().time_s);
}

TEST_F(PlayerSessionTest, ShowsInFlightWhatTheShowHasAtThatTime) {
  const std::string way = "duration_s = 20\n[camera]\n[[camera.key]]\nr = 20\n";
  const auto time_in_flight_s = [&](const std::string& scene) {
    PlayerSession session = session_on(way + scene);
    run(session, 2.0);
    session.advance(pressing(KeyAction::fly));
    run(session, 1.0);
    EXPECT_FALSE(session.frame().path_time_s.has_value());
    return session.frame().time_s;
  };
  EXPECT_NEAR(time_in_flight_s("[[caption]]\nfrom_s = 1\nto_s = 9\ntext = \"Here\"\n"), 3.0, 0.1);
  EXPECT_NEAR(time_in_flight_s("[disk]\npattern = \"procedural\"\n"), 3.0, 0.1);
  EXPECT_NEAR(time_in_flight_s("[[objects]]\nshape = \"sphere\"\nmethod = \"trace\"\norbit = { r = 12 }\n"), 3.0, 0.1);
  EXPECT_NEAR(time_in_flight_s(
                  "[[objects]]\nshape = \"sphere\"\nmethod = \"trace\"\nkey = [{ t_s = 0, position = [12, 0, 0] }, "
                  "{ t_s = 9, position = [0, 12, 0] }]\n"),
              3.0, 0.1);
  EXPECT_NEAR(time_in_flight_s("[disk]\n[[caption]]\nfrom_s = 9\nto_s = 19\ntext = \"Later\"\n"), 2.0, 0.1)
      << "one picture is like another";
}

constexpr const char* falling_show = R"(
duration_s = 20
[camera]
[camera.fall]
clock = 5
velocity = { beta = 0.2, toward = [0, 0, 1] }
[[camera.key]]
r = 20
)";

TEST_F(PlayerSessionTest, LooksAtTheVelocityOfACameraThatFalls) {
  PlayerSession session = session_on(falling_show);
  run(session, 5.0);
  const CameraPose path = camera_pose(session.show(), session.frame().time_s);
  ASSERT_TRUE(session.frame().pose.velocity.has_value());
  EXPECT_EQ(session.frame().pose.velocity->x, path.velocity->x);
  EXPECT_EQ(session.frame().observer.name, "in free fall");
}

TEST_F(PlayerSessionTest, LooksAsAnotherObserverFromACameraThatFalls) {
  PlayerSession session = session_on(falling_show);
  run(session, 5.0);
  session.advance(pressing(KeyAction::next_observer));
  run(session, 2.0);
  EXPECT_FALSE(session.frame().pose.velocity.has_value());
  EXPECT_EQ(session.frame().observer.motion, ObserverMotion::zamo);
}

TEST_F(PlayerSessionTest, ShowsNumbersThatChangeWithTime) {
  PlayerSession session = session_on(orbiting_show);
  run(session, 5.0);
  EXPECT_NEAR(session.frame().stereo.baseline, 0.6, 1e-5);
}

TEST_F(PlayerSessionTest, AsksForNoOtherPictureWhilePaused) {
  PlayerSession session = session_on(orbiting_show);
  run(session, 2.0);
  session.advance(pressing(KeyAction::pause));
  run(session, 0.1);
  EXPECT_FALSE(session.changed());
  EXPECT_FALSE(session.moving());
}

TEST_F(PlayerSessionTest, FliesWhereAPersonSteers) {
  PlayerSession session = session_on(orbiting_show, true);
  run(session, 0.1);
  const double r = session.frame().pose.r;
  PlayerInput forward;
  forward.steering.rates.forward = 1.0;
  run(session, 2.0, forward);
  EXPECT_LT(session.frame().pose.r, 0.95 * r);
  EXPECT_TRUE(session.flying());
  EXPECT_FALSE(session.frame().path_time_s.has_value());
}

TEST_F(PlayerSessionTest, StandsStillInFlightWhenNobodySteers) {
  PlayerSession session = session_on("[camera]\n[[camera.key]]\nr = 12\n", true);
  run(session, 3.0);
  EXPECT_FALSE(session.moving());
}

TEST_F(PlayerSessionTest, ComesBackToThePath) {
  PlayerSession session = session_on(orbiting_show);
  run(session, 1.0);
  session.advance(pressing(KeyAction::fly));
  PlayerInput forward;
  forward.steering.rates.forward = 1.0;
  run(session, 2.0, forward);
  session.advance(pressing(KeyAction::return_to_path));
  run(session, 30.0);
  EXPECT_FALSE(session.flying());
}

TEST_F(PlayerSessionTest, NamesTheObserverInFlight) {
  PlayerSession session = session_on(orbiting_show, true);
  run(session, 1.0);
  EXPECT_NE(session.caption(), "");
  const std::string before = session.caption();
  session.advance(pressing(KeyAction::next_observer));
  session.advance(pressing(KeyAction::next_observer));
  run(session, 2.0);
  EXPECT_NE(session.caption(), before);
}

TEST_F(PlayerSessionTest, TurnsTheDistanceOfTheEyesUntilItIsReset) {
  PlayerSession session = session_on(orbiting_show);
  session.advance(pressing(KeyAction::pause));
  const double shown = session.frame().stereo.baseline;
  session.advance(pressing(KeyAction::baseline_larger));
  EXPECT_DOUBLE_EQ(session.frame().stereo.baseline, 1.25 * shown);
  session.advance(pressing(KeyAction::baseline_reset));
  EXPECT_DOUBLE_EQ(session.frame().stereo.baseline, shown);
}

TEST_F(PlayerSessionTest, GoesBackToTheEyesThatTheShowHas) {
  PlayerSession session = session_on(orbiting_show);
  session.advance(pressing(KeyAction::pause));
  const StereoSettings shown = session.frame().stereo;
  for (const KeyAction key : {KeyAction::swap_eyes, KeyAction::tint_eyes, KeyAction::next_layout, KeyAction::next_model,
                              KeyAction::convergence_nearer, KeyAction::baseline_larger}) {
    session.advance(pressing(key));
  }
  EXPECT_NE(session.frame().stereo, shown);
  session.advance(pressing(KeyAction::baseline_reset));
  EXPECT_EQ(session.frame().stereo, shown);
}

TEST_F(PlayerSessionTest, LetsADistanceOfTheEyesChangeWithTimeAgainWhenItIsReset) {
  PlayerSession session = session_on(orbiting_show);
  session.advance(pressing(KeyAction::baseline_larger));
  session.advance(pressing(KeyAction::baseline_reset));
  run(session, 5.0);
  EXPECT_NEAR(session.frame().stereo.baseline, 0.1 + 0.1 * session.frame().time_s, 1e-6);
}

TEST_F(PlayerSessionTest, ShowsEyesSideBySideWhereTheWindowHasNoBuffersForThem) {
  Show show = parse_show(orbiting_show, "orbit.toml");
  show.stereo.layout = StereoLayout::quad_buffer;
  SessionOptions options;
  options.plain_window = true;
  PlayerSession session(show, options);
  session.advance(pressing(KeyAction::baseline_larger));
  EXPECT_EQ(session.frame().stereo.layout, StereoLayout::side_by_side);
  session.advance(pressing(KeyAction::baseline_reset));
  EXPECT_EQ(session.frame().stereo.layout, StereoLayout::side_by_side);
}

TEST_F(PlayerSessionTest, TellsItsStatus) {
  PlayerSession session = session_on(orbiting_show);
  run(session, 6.0);
  PlayerStatus status;
  session.fill(status);
  EXPECT_EQ(status.title, "Orbit");
  EXPECT_NEAR(status.time_s, 6.0, 1e-5);
  EXPECT_EQ(status.chapter, 1);
  EXPECT_EQ(status.chapters.at(1).title, "Two");
  EXPECT_TRUE(status.stereo);
  EXPECT_FALSE(status.free_flight);
}

TEST_F(PlayerSessionTest, HandsOnWhatIsNotItsMatter) {
  PlayerSession session = session_on(orbiting_show);
  PlayerInput input;
  input.actions = {KeyAction::quit, KeyAction::full_screen, KeyAction::reload};
  input.commands = {{TransportCommand::Kind::reload, 0.0, {}}};
  session.advance(input);
  EXPECT_EQ(session.take_requests(),
            (std::vector<KeyAction>{KeyAction::reload, KeyAction::quit, KeyAction::full_screen, KeyAction::reload}));
  EXPECT_TRUE(session.take_requests().empty());
}

TEST_F(PlayerSessionTest, KeepsTimeAndLanguageWhenTheShowIsReadAgain) {
  PlayerSession session = session_on(orbiting_show);
  run(session, 3.0);
  session.advance({{}, {}, {{TransportCommand::Kind::language, 0.0, "de"}}});
  session.set_show(parse_show(std::string(orbiting_show) + "[tone]\nexposure_stops = 1\n", "orbit.toml"));
  run(session, 1.0);
  EXPECT_NEAR(session.frame().time_s, 4.0, 0.02);
  EXPECT_EQ(session.frame().language, "de");
}

TEST_F(PlayerSessionTest, RecordsWhatItShows) {
  PlayerSession session = session_on(orbiting_show);
  EXPECT_FALSE(session.recorded("A flight").has_value());
  session.record();
  const CameraPose first = (run(session, 1.0 / 60.0), session.frame().pose);
  run(session, 4.0);
  const auto show = session.recorded("A flight");
  ASSERT_TRUE(show.has_value());
  EXPECT_NEAR(show->duration_s, 4.0, 0.04);
  EXPECT_NEAR(camera_pose(*show, 0.0).r, first.r, 1e-9);
  EXPECT_NEAR(camera_pose(*show, show->duration_s).r, session.frame().pose.r, 0.02);
}

//! Returns the difference between the velocities of two cameras' observers.
double observers_apart(const CameraPose& a, const CameraPose& b) {
  const Vector3<double> apart = *a.velocity - *b.velocity;
  return std::sqrt(dot(apart, apart));
}

TEST_F(PlayerSessionTest, RecordsAFallAsItWasSeen) {
  PlayerSession session = session_on(falling_show);
  run(session, 3.0);
  session.record();
  run(session, 1.0 / 60.0);
  const CameraPose first = session.frame().pose;
  run(session, 4.0);
  const Show show = parse_show(to_toml(session.recorded("A flight").value()), "flight.toml");
  EXPECT_LT(observers_apart(camera_pose(show, 0.0), first), 1e-9);
  EXPECT_LT(observers_apart(camera_pose(show, show.duration_s), session.frame().pose), 2e-3);
}

TEST_F(PlayerSessionTest, RecordsAnotherObserverWhomOneLooksAs) {
  PlayerSession session = session_on(orbiting_show);
  session.record();
  for (int i = 0; i < 5; ++i) {
    session.advance(pressing(KeyAction::next_observer));
  }
  run(session, 3.0);
  const CameraPose now = session.frame().pose;
  const Show show = session.recorded("A flight").value();
  const CameraPose then = camera_pose(show, show.duration_s);
  EXPECT_NEAR(then.velocity->x, observer_velocity(ObserverMotion::rain, spacetime_of(show), now.r, now.theta, {}).x,
              2e-3);
}

TEST_F(PlayerSessionTest, RecordsTheShowsOwnObserverByItsName) {
  PlayerSession session = session_on(orbiting_show);
  session.record();
  run(session, 2.0);
  EXPECT_FALSE(session.recorded("A flight")->camera.keys.front().velocity.has_value());
}

}  // namespace
}  // namespace ergodome
