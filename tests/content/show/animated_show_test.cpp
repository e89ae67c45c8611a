#include "content/show/animated_show.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "content/show/reading/show_reader.h"
#include "content/timeline/key_curve.h"

namespace ergodome {
namespace {

Animation animation(std::vector<NumberKey> keys) { return {"hole.spin", std::move(keys)}; }

TEST(AnimatedNumber, PassesThroughItsKeysAndHoldsBeyondThem) {
  const Animation a = animation({{0.0, 0.1}, {3.0, 0.7}, {4.0, -0.2}});
  for (const NumberKey& key : a.keys) {
    EXPECT_EQ(value_at(a, key.time_s), key.value);
  }
  EXPECT_EQ(value_at(a, -1e9), 0.1);
  EXPECT_EQ(value_at(a, 1e9), -0.2);
  EXPECT_EQ(value_at(animation({{5.0, 0.3}}), 0.0), 0.3);
}

TEST(AnimatedNumber, GoesByItsEase) {
  const auto middle = [](Ease ease) { return value_at(animation({{0.0, 0.0, ease}, {1.0, 1.0}}), 0.25); };
  EXPECT_EQ(middle(Ease::hold), 0.0);
  EXPECT_EQ(middle(Ease::linear), 0.25);
  EXPECT_NEAR(middle(Ease::in), std::pow(0.25, 3), 1e-15);
  EXPECT_NEAR(middle(Ease::out), 1.0 - std::pow(0.75, 3), 1e-15);
  const double soft = 10.0 * std::pow(0.25, 3) - 15.0 * std::pow(0.25, 4) + 6.0 * std::pow(0.25, 5);
  EXPECT_NEAR(middle(Ease::smooth), soft, 1e-15);
  EXPECT_NEAR(middle(Ease::in_out), soft, 1e-15);
}

TEST(AnimatedNumber, JumpsOnlyAfterAHold) {
  const Animation a = animation({{0.0, 0.0, Ease::hold}, {1.0, 1.0}, {2.0, 0.5}});
  EXPECT_EQ(value_at(a, std::nextafter(1.0, 0.0)), 0.0);
  EXPECT_EQ(value_at(a, 1.0), 1.0);
  EXPECT_NEAR(value_at(a, 1.01), 1.0, 1e-5);
}

TEST(AnimatedNumber, SmoothKeysOfAParabolaGiveTheParabola) {
  Animation a = animation({});
  for (int i = 3; i <= 12; ++i) {
    a.keys.push_back({1.0 * i, 0.005 * i * i});
  }
  for (double t = 4.0; t < 11.0; t += 0.07) {
    EXPECT_NEAR(value_at(a, t), 0.005 * t * t, 1e-13) << t;
  }
}

TEST(AnimatedNumber, SmoothIsTwiceContinuousAtItsKeys) {
  const Animation a = animation({{0.0, 0.0}, {1.0, 0.2}, {2.5, 0.25}, {3.0, 0.9}, {5.0, 0.1}, {6.0, 0.8}});
  constexpr double h = 2e-4;
  const auto second = [&](double t, double side) {
    const auto f = [&](int i) { return value_at(a, t + side * i * h); };
    return (2.0 * f(0) - 5.0 * f(1) + 4.0 * f(2) - f(3)) / (h * h);
  };
  const auto first = [&](double t, double side) {
    const auto f = [&](int i) { return value_at(a, t + side * i * h); };
    return side * (-3.0 * f(0) + 4.0 * f(1) - f(2)) / (2.0 * h);
  };
  for (const NumberKey& key : a.keys) {
    EXPECT_NEAR(first(key.time_s, -1.0), first(key.time_s, 1.0), 2e-4) << key.time_s;
    EXPECT_NEAR(second(key.time_s, -1.0), second(key.time_s, 1.0), 2e-3) << key.time_s;
  }
}

TEST(AnimatedNumber, NeverPassesNorTurnsBackBetweenKeys) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  std::uniform_int_distribution<int> ease(0, 5);
  for (int trial = 0; trial < 200; ++trial) {
    Animation a = animation({});
    double time_s = 0.0;
    for (int i = 0; i < 8; ++i) {
      time_s += std::pow(10.0, 2.0 * value(random));
      a.keys.push_back({time_s, value(random), static_cast<Ease>(ease(random))});
    }
    for (std::size_t i = 0; i + 1 < a.keys.size(); ++i) {
      const NumberKey& from = a.keys[i];
      const NumberKey& to = a.keys[i + 1];
      const double sign = to.value >= from.value ? 1.0 : -1.0;
      double last = from.value;
      for (int k = 1; k < 100; ++k) {
        const double now = value_at(a, from.time_s + 0.01 * k * (to.time_s - from.time_s));
        ASSERT_GE(sign * (now - last), -1e-14) << trial << " " << i << " " << k;
        ASSERT_GE(sign * (to.value - now), 0.0);
        last = now;
      }
    }
  }
}

TEST(AnimatedNumber, IsTheSameABillionSecondsLater) {
  const Animation now = animation({{0.0, 0.0}, {10.0, 0.2}, {60.0, 0.9}});
  Animation later = now;
  for (NumberKey& key : later.keys) {
    key.time_s += 1e9;
  }
  for (int i = 0; i <= 60 * 64; ++i) {
    ASSERT_EQ(value_at(later, 1e9 + i / 64.0), value_at(now, i / 64.0)) << i;
  }
}

constexpr const char* parts =
    "duration_s = 1\n[camera]\n[camera.fall]\nclock = 1\nvelocity = { beta = 0.9, toward = [1, 0, 0] }\n"
    "[[camera.key]]\nr = 10\n[view]\nprojection = \"dome\"\n[tone]\nauto = {}\n[disk]\n"
    "[effects]\npsf = {}\ntrails = {}\ndiffraction = {}\nbloom = {}\n"
    "[[shells]]\nradius = 9\n[[shells]]\nradius = 9\n[[shells]]\nradius = 9\n[[shells]]\nradius = 9\n"
    "[[shells]]\nradius = 9\n[[shells]]\nradius = 9\n[[shells]]\nradius = 9\n[[shells]]\nradius = 9\n"
    "[[shells]]\nradius = 9\n[[shells]]\nradius = 9\n[[shells]]\nradius = 9\n[[shells]]\nradius = 9\n"
    "[[shells]]\nradius = 9\n[[shells]]\nradius = 9\n[[shells]]\nradius = 9\n[[shells]]\nradius = 9\n";

TEST(AnimatedShow, EveryNumberOfTheListFollowsItsKeysAndKeepsItsLimits) {
  for (const AnimatableNumber& number : animatable_numbers()) {
    Show show = parse_show(parts, "show.toml");
    const NumberLimits limits = limits_in(show, number);
    show.timeline.animations = {{std::string(number.path), {{0.0, limits.minimum}, {1.0, limits.maximum}}}};
    EXPECT_EQ(number.get(show_at(show, 0.0)), limits.minimum) << number.path;
    EXPECT_EQ(number.get(show_at(show, 1.0)), limits.maximum) << number.path;
    const double middle = number.get(show_at(show, 0.5)).value();
    EXPECT_NEAR(middle, 0.5 * (limits.minimum + limits.maximum), 1e-12 * limits.maximum) << number.path;
  }
}

TEST(AnimatedShow, EveryNumberOfTheListIsAKeyOfAShowWithTheSameLimits) {
  for (const AnimatableNumber& number : animatable_numbers()) {
    const auto read = [&](double value) {
      Show show = parse_show(parts, "show.toml");
      // Some keys must be in order: the fade angles of stereo, and the limits of automatic
      // exposure. Wide limits let the test set each of them alone.
      show.stereo.fade_from_deg = 0.0;
      show.stereo.fade_to_deg = 90.0;
      show.tone.automatic->least_stops = -40.0;
      show.tone.automatic->most_stops = 40.0;
      show.stereo.convergence = 1.0;
      number.put(show, value);
      return number.get(parse_show(to_toml(show), "show.toml")).value();
    };
    const NumberLimits limits = limits_in(parse_show(parts, "show.toml"), number);
    const double inside = 0.75 * limits.minimum + 0.25 * limits.maximum;
    EXPECT_EQ(read(inside), inside) << number.path;
    EXPECT_ANY_THROW(read(limits.maximum * 1.001 + 0.001)) << number.path;
  }
}

TEST(AnimatedShow, TellsWhatAChangeCallsFor) {
  Show show = parse_show(
      std::string(parts) +
          "[[animate]]\nnumber = \"sky.spin_axis.ra_deg\"\nkey = [{ t_s = 0, value = 0 }, { t_s = 1, value = 9 }]\n"
          "[[animate]]\nnumber = \"sky.faintest_mag\"\nkey = [{ t_s = 2, value = 0 }, { t_s = 3, value = 9 }]\n",
      "show.toml");
  EXPECT_TRUE(animate(show, 0.0).sky);
  EXPECT_FALSE(animate(show, 0.0).sky);
  EXPECT_TRUE(animate(show, 0.5).sky);
  EXPECT_TRUE(animate(show, 1.0).sky);
  const NumberChange later = animate(show, 2.5);
  EXPECT_FALSE(later.sky);
  EXPECT_TRUE(later.stars);
}

TEST(AnimatedShow, ExtremesHoldWhateverANumberEverIs) {
  Show show = parse_show(parts, "show.toml");
  show.timeline.animations = {{"effects.bloom.strength", {{0.0, 0.2}, {1.0, 0.9}, {2.0, 0.1}}}};
  EXPECT_EQ(show_at_least(show).effects.bloom->strength, 0.1);
  EXPECT_EQ(show_at_most(show).effects.bloom->strength, 0.9);
}

}  // namespace
}  // namespace ergodome
