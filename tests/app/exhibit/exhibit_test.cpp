#include "app/exhibit/exhibit.h"

#include <GLFW/glfw3.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "app/player/player_inputs.h"

namespace ergodome {
namespace {

constexpr ExhibitTimes times = {.idle_s = 60.0, .session_s = 0.0, .welcome_s = 8.0, .rest_s = 3.0};

TEST(Exhibit, BeginsWithTheAttractShow) { EXPECT_EQ(Exhibit(times).scene(), ExhibitScene::attract); }

TEST(Exhibit, AnyTouchBeginsAFlight) {
  Exhibit exhibit(times);
  EXPECT_FALSE(exhibit.advance(10.0, false));
  EXPECT_TRUE(exhibit.advance(10.1, true));
  EXPECT_EQ(exhibit.scene(), ExhibitScene::visitor);
}

TEST(Exhibit, ComesBackToTheAttractShowWhenNobodyTouchesIt) {
  Exhibit exhibit(times);
  exhibit.advance(0.0, true);
  EXPECT_FALSE(exhibit.advance(59.9, false));
  EXPECT_TRUE(exhibit.advance(60.0, false));
  EXPECT_EQ(exhibit.scene(), ExhibitScene::attract);
}

TEST(Exhibit, StaysWithAVisitorWhoTouchesIt) {
  Exhibit exhibit(times);
  exhibit.advance(0.0, true);
  for (double now_s = 1.0; now_s < 7200.0; now_s += 50.0) {
    EXPECT_FALSE(exhibit.advance(now_s, true));
  }
  EXPECT_EQ(exhibit.scene(), ExhibitScene::visitor);
}

TEST(Exhibit, EndsALimitedSessionHoweverItIsTouched) {
  Exhibit exhibit({.idle_s = 60.0, .session_s = 120.0, .welcome_s = 8.0, .rest_s = 3.0});
  exhibit.advance(0.0, true);
  for (double now_s = 0.5; now_s < 120.0; now_s += 0.5) {
    ASSERT_FALSE(exhibit.advance(now_s, true));
  }
  EXPECT_TRUE(exhibit.advance(120.0, true));
  EXPECT_EQ(exhibit.scene(), ExhibitScene::attract);
}

TEST(Exhibit, GivesTheNextVisitorATurnAfterThreeMinutesByItself) {
  Exhibit exhibit{ExhibitTimes{}};
  exhibit.advance(0.0, true);
  EXPECT_FALSE(exhibit.advance(179.0, true));
  EXPECT_DOUBLE_EQ(exhibit.ending_in_s().value_or(-1.0), 1.0);
  EXPECT_TRUE(exhibit.advance(180.0, true));
}

TEST(Exhibit, RestsAfterALimitedSession) {
  Exhibit exhibit({.idle_s = 60.0, .session_s = 120.0, .welcome_s = 8.0, .rest_s = 3.0});
  exhibit.advance(0.0, true);
  exhibit.advance(120.0, true);
  EXPECT_FALSE(exhibit.advance(122.9, true));
  EXPECT_TRUE(exhibit.advance(123.1, true));
}

TEST(Exhibit, SaysWhenASessionIsAboutToEnd) {
  Exhibit exhibit({.idle_s = 600.0, .session_s = 120.0, .welcome_s = 8.0, .rest_s = 3.0});
  exhibit.advance(0.0, true);
  exhibit.advance(99.0, false);
  EXPECT_FALSE(exhibit.ending_in_s().has_value());
  exhibit.advance(113.0, false);
  EXPECT_DOUBLE_EQ(exhibit.ending_in_s().value_or(-1.0), 7.0);
}

TEST(Exhibit, WelcomesAVisitorForAWhile) {
  Exhibit exhibit(times);
  EXPECT_EQ(exhibit.welcome(), 0.0);
  exhibit.advance(100.0, true);
  exhibit.advance(104.0, true);
  EXPECT_EQ(exhibit.welcome(), 1.0);
  exhibit.advance(107.5, true);
  EXPECT_DOUBLE_EQ(exhibit.welcome(), 0.5);
  exhibit.advance(109.0, true);
  EXPECT_EQ(exhibit.welcome(), 0.0);
}

TEST(Exhibit, DoesNotGoBackWithAClockThatDoes) {
  Exhibit exhibit(times);
  exhibit.advance(1000.0, true);
  EXPECT_FALSE(exhibit.advance(10.0, false));
  EXPECT_FALSE(exhibit.advance(1059.0, false));
  EXPECT_TRUE(exhibit.advance(1060.0, false));
}

TEST(HeldSwitch, ClosesWhenItWasHeldLongEnough) {
  HeldSwitch chord(2.0);
  EXPECT_FALSE(chord.advance(5.0, true));
  EXPECT_FALSE(chord.advance(6.9, true));
  EXPECT_TRUE(chord.advance(7.0, true));
}

TEST(HeldSwitch, BeginsAnewWhenItWasLetGo) {
  HeldSwitch chord(2.0);
  chord.advance(5.0, true);
  chord.advance(6.0, false);
  EXPECT_FALSE(chord.advance(6.5, true));
  EXPECT_FALSE(chord.advance(8.0, true));
}

TEST(PlayerInputs, APointerSteersWhileAButtonIsHeldAlone) {
  PlayerInputs inputs(Controls{});
  const WindowEvent moved{WindowEvent::Kind::pointer, 0, 20.0, 10.0};
  EXPECT_EQ(inputs.gather(std::array{moved}, {}, 1e-3).steering.amounts, Steering());
  const WindowEvent pressed{WindowEvent::Kind::button_down, 0, 0.0, 0.0};
  EXPECT_LT(inputs.gather(std::array{pressed, moved}, {}, 1e-3).steering.amounts.yaw, 0.0);
  EXPECT_LT(inputs.gather(std::array{moved}, {}, 1e-3).steering.amounts.yaw, 0.0);
  const WindowEvent released{WindowEvent::Kind::button_up, 0, 0.0, 0.0};
  EXPECT_EQ(inputs.gather(std::array{released, moved}, {}, 1e-3).steering.amounts, Steering());
  EXPECT_EQ(inputs.gather(std::array{moved, pressed}, {}, 1e-3).steering.amounts, Steering()) << "came before it";
}

//! Returns whether these keys, pressed one after the other and held, are the operator's key
//! combination.
bool is_chord(const std::string& controls, std::initializer_list<int> keys) {
  PlayerInputs inputs(parse_controls(controls, "controls.toml"));
  inputs.set_lock(InputLock::visitors);
  std::vector<WindowEvent> events;
  for (const int key : keys) {
    events.push_back({WindowEvent::Kind::key_down, key});
  }
  static_cast<void>(inputs.gather(events, {}, 1e-3));
  return inputs.chord_held();
}

TEST(OperatorsChord, IsWhatTheKeysSay) {
  EXPECT_TRUE(is_chord("", {GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_ALT, GLFW_KEY_Q}));
  EXPECT_FALSE(is_chord("", {GLFW_KEY_LEFT_CONTROL, GLFW_KEY_LEFT_SHIFT, GLFW_KEY_Q}));
  EXPECT_FALSE(is_chord("", {GLFW_KEY_LEFT_CONTROL, GLFW_KEY_Q}));
}

TEST(OperatorsChord, MayBeBoundToOtherKeys) {
  const std::string controls = "[actions]\nleave_exhibit = \"Ctrl+F9\"\n";
  EXPECT_TRUE(is_chord(controls, {GLFW_KEY_LEFT_CONTROL, GLFW_KEY_F9}));
  EXPECT_TRUE(is_chord(controls, {GLFW_KEY_LEFT_CONTROL, GLFW_KEY_LEFT_ALT, GLFW_KEY_Q}));
  EXPECT_FALSE(is_chord(controls, {GLFW_KEY_F9}));
}

TEST(PlayerInputs, AreTouchedForAsLongAsAKeyIsHeld) {
  PlayerInputs inputs{Controls()};
  const auto touched_after = [&](const std::vector<WindowEvent>& events) {
    static_cast<void>(inputs.gather(events, {}, 1e-3));
    return inputs.touched();
  };
  EXPECT_TRUE(touched_after({{WindowEvent::Kind::key_down, GLFW_KEY_W}}));
  EXPECT_TRUE(touched_after({}));
  EXPECT_TRUE(touched_after({{WindowEvent::Kind::key_up, GLFW_KEY_W}}));
  EXPECT_FALSE(touched_after({}));
}

TEST(PlayerInputs, DoNotSteerByAKeyThatWasPressedForAnAction) {
  PlayerInputs inputs{Controls()};
  const auto after = [&](WindowEvent::Kind kind, int key) {
    const std::vector<WindowEvent> events = {{kind, key}};
    return inputs.gather(events, {}, 1e-3);
  };
  after(WindowEvent::Kind::key_down, GLFW_KEY_LEFT_CONTROL);
  const PlayerInput pressed = after(WindowEvent::Kind::key_down, GLFW_KEY_R);
  EXPECT_EQ(pressed.actions, std::vector{KeyAction::reload});
  EXPECT_EQ(after(WindowEvent::Kind::key_up, GLFW_KEY_LEFT_CONTROL).steering.rates.up, 0.0);
  after(WindowEvent::Kind::key_up, GLFW_KEY_R);
  EXPECT_EQ(after(WindowEvent::Kind::key_down, GLFW_KEY_R).steering.rates.up, 1.0);
}

}  // namespace
}  // namespace ergodome
