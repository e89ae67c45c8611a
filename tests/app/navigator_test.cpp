#include "app/navigation/navigator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "content/show_reader.h"
#include "kernels/core/angles.h"
#include "kernels/metric/kerr.h"
#include "tests/support/sanitized.h"

namespace ergodome {
namespace {

constexpr double frame_s = 1.0 / 60.0;

Show show_at(double spin, double r, double theta_deg = 90.0, const std::string& flight = "") {
  return parse_show("duration_s = 60\n[hole]\nspin = " + std::to_string(spin) + "\n[camera]\n[[camera.key]]\nr = " +
                        std::to_string(r) + "\ntheta_deg = " + std::to_string(theta_deg) + "\n[flight]\n" + flight,
                    "f.toml");
}

SteeringInput holding(const Steering& rates) { return {rates, {}}; }

class Flier {
 public:
  explicit Flier(const Show& show) : path(camera_pose(show, 0.0)), navigator(show) { navigator.leave_path(); }

  void hold(const Steering& rates, double seconds) {
    for (double t = 0.0; t < seconds - 1e-9; t += frame_s) {
      navigator.advance(frame_s, holding(rates), path);
    }
  }

  CameraPose path;
  Navigator navigator;
};

Steering forward_only(double forward) {
  Steering s;
  s.forward = forward;
  s.faster = 1.0;
  return s;
}

//! Where the view looks, in directions that do not turn.
glm::dvec3 looks_at(const Navigator& navigator) { return place_of(navigator.pose()).view * glm::dvec3(0.0, 0.0, -1.0); }

double angle_between(const glm::dquat& a, const glm::dquat& b) { return glm::length(turn_of(b * glm::conjugate(a))); }

TEST(FlightSpace, GuardsAreOutsideTheHorizonAndOutsideEveryOrbitOfLight) {
  FlightSettings settings;
  EXPECT_NEAR(guard_radius(0.0, settings), 2.02, 1e-12);
  settings.guard = FlightGuard::photon_orbit;
  EXPECT_NEAR(guard_radius(1.0, settings), 4.04, 1e-12);   // light goes round backwards at 4
  EXPECT_NEAR(guard_radius(-1.0, settings), 4.04, 1e-12);  // whichever way the hole turns
  settings.least_r = 7.0;
  EXPECT_EQ(guard_radius(0.0, settings), 7.0);
}

//! Any input at all, also such as no device sends.
Steering wild(std::mt19937& random) {
  std::uniform_real_distribution<double> rate(-1.5, 1.5);
  const auto pick = [&] {
    switch (random() % 12) {
      case 0:
        return std::nan("");
      case 1:
        return 1e300;
      case 2:
        return -1.0;
      default:
        return rate(random);
    }
  };
  return {pick(), pick(), pick(), pick(), pick(), pick(), pick(), pick()};
}

void play_wildly(Navigator& navigator, std::mt19937& random, const CameraPose& path) {
  constexpr double times_s[] = {0.0, 1e-9, 1.0 / 240, 1.0 / 60, 0.1, 5.0, -1.0, 1e300, NAN};
  switch (random() % 40) {
    case 0:
      navigator.next_mode();
      break;
    case 1:
      navigator.return_to_path();
      break;
    case 2:
      navigator.leave_path();
      break;
    case 3:
      navigator.reverse_orbit();
      break;
    default:
      break;
  }
  const Steering rates = random() % 3 == 0 ? forward_only(1.0) : wild(random);
  navigator.advance(times_s[random() % 9], {rates, random() % 5 == 0 ? wild(random) : Steering{}}, path);
}

TEST(Navigator, NeverComesWithinItsGuardWhateverIsAskedAndHoweverLongAFrameTakes) {
  constexpr int inputs = 10'000;
  for (const double spin : {0.0, 0.5, 0.999, 1.0, -0.9}) {
    for (const char* guard : {"horizon", "photon_orbit"}) {
      const Show show =
          show_at(spin, 6.0, 50.0, std::string("guard = \"") + guard + "\"\nmax_speed = 3\nmost_r = 50\n");
      Navigator navigator(show);
      navigator.leave_path();
      std::mt19937 random(7);
      const CameraPose path = camera_pose(show, 0.0);
      double nearest = 100.0;
      for (int i = 0; i < inputs; ++i) {
        play_wildly(navigator, random, path);
        const CameraPose pose = navigator.pose();
        ASSERT_TRUE(pose.r > guard_radius(spin, show.flight) && pose.r <= 50.0 * (1.0 + 1e-9)) << pose.r << " at " << i;
        ASSERT_TRUE(std::isfinite(pose.theta + pose.phi)) << i;
        ASSERT_NEAR(glm::length(pose.orientation), 1.0, 1e-9) << i;
        nearest = std::min(nearest, pose.r);
      }
      EXPECT_LT(nearest, 1.5 * guard_radius(spin, show.flight)) << "the guard was never tried";
    }
  }
}

TEST(Navigator, NearsTheGuardSmoothlyAndLeavesItAgain) {
  Flier flier(show_at(0.9, 6.0));
  const double guard = flier.navigator.space().guard_r();
  double height = 6.0 - guard;
  for (int i = 0; i < 3000; ++i) {
    flier.hold(forward_only(1.0), frame_s);
    const double now = flier.navigator.pose().r - guard;
    ASSERT_LE(now, height) << "went back by itself in frame " << i;
    height = now;
  }
  EXPECT_LT(height, 1e-4);
  flier.hold(forward_only(-1.0), 20.0);
  EXPECT_GT(flier.navigator.pose().r, 10.0);
}

TEST(Navigator, NearsTheFarLimitSmoothlyToo) {
  Flier flier(show_at(0.9, 6.0, 90.0, "most_r = 40\n"));
  flier.hold(forward_only(-1.0), 60.0);
  EXPECT_NEAR(flier.navigator.pose().r, 40.0, 1e-6);
  EXPECT_LE(flier.navigator.pose().r, 40.0);
}

TEST(Navigator, FliesAMillionMOut) {
  Flier flier(show_at(0.9, 1e6, 90.0, "most_r = 1e8\nmode = \"fly\"\n"));
  flier.hold(forward_only(1.0), 60.0);
  EXPECT_LT(flier.navigator.pose().r, 10.0);  // speed goes with the distance
  flier.hold(forward_only(-1.0), 60.0);
  EXPECT_TRUE(std::isfinite(flier.navigator.pose().r));
}

//! Holds one thing after another and looks at the fastest turn, its fastest change, and those of a ship's velocity.
struct Worst {
  double turn = 0.0;
  double turn_change = 0.0;
  double speed = 0.0;
  double speed_change = 0.0;
};

Worst worst_of(Navigator& navigator, const CameraPose& path, int frames,
               const std::function<SteeringInput(int)>& input) {
  constexpr double step_s = 1.0 / 240.0;  // as long as the navigator's own steps, so that finite differences see each
  Worst worst;
  glm::dquat view = place_of(navigator.pose()).view;
  glm::dvec3 turn = navigator.turn_rate();
  glm::dvec3 velocity = navigator.fly_velocity();
  for (int i = 0; i < frames; ++i) {
    navigator.advance(step_s, input(i), path);
    const glm::dquat now = place_of(navigator.pose()).view;
    const glm::dvec3 rate = turn_of(now * glm::conjugate(view)) / step_s;
    worst.turn = std::max(worst.turn, glm::length(rate));
    worst.turn_change = std::max(worst.turn_change, glm::length(rate - turn) / step_s);
    worst.speed = std::max(worst.speed, glm::length(navigator.fly_velocity()));
    worst.speed_change = std::max(worst.speed_change, glm::length(navigator.fly_velocity() - velocity) / step_s);
    view = now;
    turn = rate;
    velocity = navigator.fly_velocity();
  }
  return worst;
}

void expect_comfort(const Worst& worst, const FlightSettings& settings) {
  EXPECT_LE(worst.turn, pi / 180.0 * settings.comfort.turn_deg_s * (1.0 + 1e-6));
  EXPECT_LE(worst.turn_change, pi / 180.0 * settings.comfort.turn_accel_deg_s2 * (1.0 + 1e-6));
  EXPECT_LE(worst.speed, settings.max_speed * (1.0 + 1e-9));
  EXPECT_LE(worst.speed_change, settings.comfort.accel * (1.0 + 1e-9));
}

TEST(Comfort, HoldsAgainstFullReversalsInEveryAxisAtTheWorstPeriods) {
  for (const char* mode : {"orbit", "fly"}) {
    for (const int period : {1, 7, 40, 160, 500}) {
      const Show show = show_at(0.9, 8.0, 60.0, std::string("mode = \"") + mode + "\"\n");
      Flier flier(show);
      const auto input = [&](int i) {
        const double s = (i / period) % 2 == 0 ? 1.0 : -1.0;
        return holding({s, s, -s, s, -s, s, 0.0, 1.0});
      };
      expect_comfort(worst_of(flier.navigator, flier.path, 3000, input), show.flight);
    }
  }
}

TEST(Comfort, HoldsAgainstAnythingAVisitorDoesWithTightLimitsToo) {
  for (const char* limits : {"comfort = { turn_deg_s = 10, turn_accel_deg_s2 = 5, accel = 0.2 }\n",
                             "comfort = { turn_deg_s = 200, turn_accel_deg_s2 = 2000, accel = 20 }\n", ""}) {
    const Show show = show_at(0.9, 8.0, 20.0, limits);
    Flier flier(show);
    std::mt19937 random(3);
    Steering held;
    const auto input = [&](int i) {
      if (i % 37 == 0) {
        held = wild(random);
      }
      if (i % 400 == 399) {
        flier.navigator.next_mode();
      }
      return SteeringInput{held, i % 90 == 0 ? wild(random) : Steering{}};
    };
    expect_comfort(worst_of(flier.navigator, flier.path, test::sanitized ? 4000 : 40'000, input), show.flight);
  }
}

TEST(Comfort, UsesWhatIsAllowed) {
  const Show show = show_at(0.9, 8.0, 60.0, "mode = \"fly\"\n");
  Flier flier(show);
  const Worst worst = worst_of(flier.navigator, flier.path, 1500, [](int) {
    return holding({0.0, 0.0, -1.0, 1.0, 0.0, 0.0, 0.0, 1.0});
  });
  EXPECT_GT(worst.turn, 0.5 * pi / 180.0 * show.flight.comfort.turn_deg_s);
  EXPECT_GT(worst.speed, 0.99 * show.flight.max_speed);
}

TEST(Navigator, OrbitsOverThePoleWithoutALeapOfTheHoleInTheView) {
  Flier flier(show_at(0.9, 8.0, 40.0));
  Steering up;
  up.up = 1.0;
  flier.hold(up, 2.0);
  glm::dvec3 star = looks_at(flier.navigator);
  double phi = flier.navigator.pose().phi;
  double leap = 0.0;
  for (int i = 0; i < 240; ++i) {
    flier.hold(up, frame_s);
    const glm::dvec3 now = looks_at(flier.navigator);
    EXPECT_LT(glm::distance(now, star), 1.01 * pi / 3.0 * frame_s);
    EXPECT_GT(glm::dot(now, -place_of(flier.navigator.pose()).towards), 0.99);
    leap = std::max(leap, std::abs(flier.navigator.pose().phi - phi));
    phi = flier.navigator.pose().phi;
    star = now;
  }
  EXPECT_NEAR(leap, pi, 1e-6);  // it did go over the pole
}

TEST(Navigator, GoesOnEastwardsAsTheScreenHasItOnBothSidesOfThePole) {
  Flier flier(show_at(0.0, 8.0, 10.0));
  Steering up;
  up.up = 1.0;
  flier.hold(up, 4.0);  // well beyond the pole
  Steering right;
  right.right = 1.0;
  flier.hold({}, 2.0);
  const CameraPlace before = place_of(flier.navigator.pose());
  flier.hold(right, 0.5);
  const glm::dvec3 way = place_of(flier.navigator.pose()).towards - before.towards;
  EXPECT_GT(glm::dot(way, before.view * glm::dvec3(1.0, 0.0, 0.0)), 0.9 * glm::length(way));
}

TEST(Navigator, FarStarsKeepTheirPlaceInAShipThatPassesThePole) {
  Show show = show_at(0.9, 9.0, 5.0, "mode = \"fly\"\n");
  show.camera.keys[0].look = {LookTarget::Kind::direction, {0.0, -1.0, 0.0}};  // along the meridian
  Flier flier(show);
  const glm::dvec3 star = looks_at(flier.navigator);
  const glm::dquat local = flier.navigator.pose().orientation;
  flier.hold(forward_only(1.0), 3.0);
  EXPECT_LT(glm::distance(looks_at(flier.navigator), star), 1e-9);
  EXPECT_NEAR(std::abs(flier.navigator.pose().phi), pi, 1e-6);
  EXPECT_GT(angle_between(local, flier.navigator.pose().orientation), 3.0);  // the local frame has turned round
}

//! A length in the space of the zero-angular-momentum observer, by the metric (Bardeen, Press & Teukolsky 1972, eq. 2.3).
double proper_length(double spin, const CameraPose& a, const CameraPose& b) {
  const double r = 0.5 * (a.r + b.r);
  const double theta = 0.5 * (a.theta + b.theta);
  const double sigma = r * r + spin * spin * std::cos(theta) * std::cos(theta);
  const double delta = r * r - 2.0 * r + spin * spin;
  const double sine2 = std::sin(theta) * std::sin(theta);
  const double around = (r * r + spin * spin + 2.0 * spin * spin * r * sine2 / sigma) * sine2;
  const double dr = b.r - a.r;
  const double dtheta = b.theta - a.theta;
  const double dphi = std::remainder(b.phi - a.phi, 2.0 * pi);
  return std::sqrt(sigma / delta * dr * dr + sigma * dtheta * dtheta + around * dphi * dphi);
}

TEST(Navigator, AShipsSpeedIsThatOfTheLocalSpace) {
  for (const double spin : {0.0, 0.9, 1.0}) {
    for (const Steering& way : {Steering{1.0, 0.0, 0.0}, Steering{0.0, 1.0, 0.0}, Steering{0.3, -0.7, -0.4}}) {
      Flier flier(show_at(spin, 3.0, 70.0, "mode = \"fly\"\n"));
      flier.hold(way, 2.0);
      const CameraPose before = flier.navigator.pose();
      const glm::dvec3 velocity = flier.navigator.fly_velocity();
      constexpr double moment_s = 1e-4;
      flier.navigator.advance(moment_s, holding(way), flier.path);
      const double expected = glm::length(velocity) * flier.navigator.space().distance(before.r) * moment_s;
      EXPECT_NEAR(proper_length(spin, before, flier.navigator.pose()) / expected, 1.0, 1e-3);
    }
  }
}

TEST(Navigator, HoveringStaysAndLooksAround) {
  Flier flier(show_at(0.9, 6.0, 70.0, "mode = \"hover\"\n"));
  const CameraPose before = flier.navigator.pose();
  flier.hold({1.0, 1.0, 1.0, 1.0}, 2.0);
  EXPECT_EQ(flier.navigator.pose().r, before.r);
  EXPECT_NEAR(flier.navigator.pose().theta, before.theta, 1e-12);
  EXPECT_GT(angle_between(flier.navigator.pose().orientation, before.orientation), 0.3);
  EXPECT_EQ(flier.navigator.own_observer()->name, "static observer");
}

TEST(Navigator, RidesACircularOrbitOnceInFortySeconds) {
  Flier flier(show_at(0.9, 9.0, 90.0, "mode = \"geodesic\"\n"));
  flier.hold({}, 3.0);
  double turned = 0.0;
  double phi = flier.navigator.pose().phi;
  for (int i = 0; i < 600; ++i) {
    flier.hold({}, frame_s);
    turned += std::remainder(flier.navigator.pose().phi - phi, 2.0 * pi);
    phi = flier.navigator.pose().phi;
    ASSERT_NEAR(flier.navigator.pose().r, 9.0, 1e-7);
  }
  EXPECT_NEAR(turned, 0.5 * pi, 0.5);  // own time runs slower than the clock of the stars
  const Vector3<double> v = flier.navigator.own_observer()->velocity;
  const Vector3<double> circular = observer_velocity(ObserverMotion::geodesic, 0.9, 9.0, pi / 2, {});
  EXPECT_NEAR(v.z, circular.z, 1e-8);
}

TEST(Navigator, TheHoleStaysWhereItIsInTheViewOfAnInclinedOrbit) {
  Flier flier(show_at(0.9, 12.0, 40.0, "mode = \"geodesic\"\n"));
  flier.navigator.ride({0.0, 0.3, 0.05});
  double south = 0.0;
  for (int i = 0; i < 3000; ++i) {
    flier.hold({}, frame_s);
    ASSERT_GT(glm::dot(looks_at(flier.navigator), -place_of(flier.navigator.pose()).towards), 0.999);
    south = std::max(south, flier.navigator.pose().theta);
  }
  EXPECT_GT(south, 2.2);
}

TEST(Navigator, AnOrbitThatFallsInComesToRestBeforeTheGuardAndSaysSo) {
  Flier flier(show_at(0.9, 4.0, 90.0, "mode = \"geodesic\"\n"));
  flier.navigator.ride({-0.5, 0.0, 0.1});
  flier.hold({}, 40.0);
  EXPECT_GT(flier.navigator.pose().r, flier.navigator.space().guard_r());
  EXPECT_LT(flier.navigator.pose().r, 1.01 * flier.navigator.space().guard_r());
  EXPECT_NE(flier.navigator.own_observer()->sentence.find("time stands still"), std::string::npos);
}

//! A show whose path moves all the time.
Show moving_show(double spin = 0.9) {
  return parse_show("duration_s = 100\n[hole]\nspin = " + std::to_string(spin) + R"(
[camera]
[[camera.key]]
t_s = 0
r = 12
theta_deg = 80
[[camera.key]]
t_s = 50
r = 6
theta_deg = 30
phi_deg = 300
yaw_deg = 40
[[camera.key]]
t_s = 100
r = 9
theta_deg = 90
phi_deg = 500
)",
                    "m.toml");
}

//! Plays the path, leaves it, flies, goes back; the largest changes of velocity (of the place, over r, and of the view) from frame to frame.
struct Journey {
  double place_change = 0.0;
  double view_change = 0.0;
  double time_back_s = 0.0;
  double end_error = 0.0;
};

Journey journey(const Show& show, const Steering& away, double away_s) {
  Navigator navigator(show);
  double time_s = 20.0;
  CameraPlace last;
  glm::dvec3 way{0.0};
  glm::dvec3 turn{0.0};
  Journey journey;
  int frame = 0;
  const auto play = [&](const Steering& steering) {
    time_s += frame_s;
    navigator.advance(frame_s, holding(steering), camera_pose(show, time_s));
    const CameraPlace now = place_of(navigator.pose());
    const glm::dvec3 new_way = (now.r * now.towards - last.r * last.towards) / (now.r * frame_s);
    const glm::dvec3 new_turn = turn_of(now.view * glm::conjugate(last.view)) / frame_s;
    if (frame++ > 1) {
      journey.place_change = std::max(journey.place_change, glm::distance(new_way, way));
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
  const CameraPlace path = place_of(camera_pose(show, time_s));
  journey.end_error = glm::distance(path.r * path.towards, last.r * last.towards) + angle_between(path.view, last.view);
  return journey;
}

TEST(PathReturn, BeginsAndEndsWithTheSameVelocityAndArrivesInTime) {
  for (const Steering& away :
       {Steering{}, Steering{1.0, 0.0, -1.0}, Steering{0.0, 1.0, 1.0, 0.5, 0.2}, Steering{-1.0, -1.0, 0.4, -1.0}}) {
    const Journey back = journey(moving_show(), away, 4.0);
    // A leap would change a velocity by its own size, some 0.3 a second; what the limits and the blend allow in a frame is far less.
    EXPECT_LT(back.place_change, 0.05);
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
  CameraPlace last = place_of(navigator.pose());
  for (int i = 0; i < 600; ++i) {
    navigator.advance(frame_s, {}, camera_pose(show, i < 60 ? 1.0 : 80.0));
    const CameraPlace now = place_of(navigator.pose());
    ASSERT_LT(glm::distance(now.r * now.towards, last.r * last.towards), 0.3);
    last = now;
  }
  EXPECT_NEAR(navigator.pose().r, camera_pose(show, 80.0).r, 1e-12);
}

TEST(Navigator, BringsACameraOutThatThePathHadLedIn) {
  Flier flier(show_at(0.9, 2.5, 90.0, "guard = \"photon_orbit\"\n"));
  double r = 2.5;
  for (int i = 0; i < 600; ++i) {
    flier.hold(forward_only(1.0), frame_s);
    ASSERT_LT(flier.navigator.pose().r - r, 0.1);
    ASSERT_GE(flier.navigator.pose().r, r - 0.01);
    r = flier.navigator.pose().r;
  }
  EXPECT_GE(r, flier.navigator.space().guard_r());
}

TEST(Navigator, StartsFromTheFirstKeyWhereTheShowSaysSo) {
  Show show = moving_show();
  show.flight.from = FlightStart::first_key;
  Navigator navigator(show);
  navigator.advance(frame_s, {}, camera_pose(show, 50.0));
  navigator.leave_path();
  EXPECT_NEAR(navigator.pose().r, 12.0, 1e-12);
}

TEST(Navigator, ResetGoesToTheStartAtRest) {
  Flier flier(show_at(0.9, 8.0));
  flier.hold({1.0, 1.0, 1.0, 1.0}, 3.0);
  flier.navigator.reset();
  flier.hold({}, 1.0);
  EXPECT_NEAR(flier.navigator.pose().r, 8.0, 1e-12);
  EXPECT_NEAR(flier.navigator.pose().phi, 0.0, 1e-12);
}

TEST(Navigator, AMouseTurnsTheViewByTheAngleItWasMoved) {
  Flier flier(show_at(0.9, 8.0, 90.0, "mode = \"fly\"\n"));
  SteeringInput drag;
  drag.amounts.yaw = 0.3;
  const glm::dquat before = place_of(flier.navigator.pose()).view;
  flier.navigator.advance(frame_s, drag, flier.path);
  flier.hold({}, 4.0);
  EXPECT_NEAR(angle_between(before, place_of(flier.navigator.pose()).view), 0.3, 1e-3);
  EXPECT_GT(glm::dot(looks_at(flier.navigator), before * glm::dvec3(1.0, 0.0, 0.0)), 0.2);  // to the right
}

TEST(Navigator, StaysOutsideAHoleWhoseHorizonGrows) {
  Flier flier(show_at(1.0, 3.0));
  flier.hold(forward_only(1.0), 30.0);
  EXPECT_LT(flier.navigator.pose().r, 1.1);
  flier.navigator.set_spin(0.0);
  flier.hold(forward_only(1.0), 1.0);
  EXPECT_GT(flier.navigator.pose().r, 2.0);
}

TEST(Navigator, SaysWhenNothingMoves) {
  Flier flier(show_at(0.9, 8.0));
  flier.hold({1.0}, 0.5);
  EXPECT_TRUE(flier.navigator.moved());
  flier.hold({}, 5.0);
  EXPECT_FALSE(flier.navigator.moved());
}

}  // namespace
}  // namespace ergodome
