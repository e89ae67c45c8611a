#include "app/player/outputs/headset_pad.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/navigation/controls/controls.h"

namespace ergodome {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

HeadsetHands two_controllers() {
  HeadsetHands hands;
  hands[0].connected = true;
  hands[1].connected = true;
  return hands;
}

HeadsetHands two_tracked_hands() {
  HeadsetHands hands = two_controllers();
  hands[0].has_stick = false;
  hands[1].has_stick = false;
  return hands;
}

//! Returns the steering of the default controls.
Steering steering_of(const HeadsetHands& hands) { return Controls().steering({}, {}, pad_of(hands)).rates; }

//! Returns the actions of the default controls when these parts are pressed.
std::vector<KeyAction> actions_of(const HeadsetHands& hands) { return Controls().pressed({}, pad_of(hands)); }

TEST(HeadsetPads, RestWithTheControllers) {
  EXPECT_EQ(pad_of({}), PadState());
  EXPECT_EQ(pad_of(two_controllers()), PadState());
}

TEST(HeadsetPads, FlyWithTheLeftStick) {
  HeadsetHands hands = two_controllers();
  hands[0].stick_y = 1.0;
  EXPECT_EQ(steering_of(hands), (Steering{.forward = 1.0}));
  hands[0].stick_y = 0.0;
  hands[0].stick_x = -1.0;
  EXPECT_EQ(steering_of(hands), (Steering{.right = -1.0}));
}

TEST(HeadsetPads, LookWithTheRightStick) {
  HeadsetHands hands = two_controllers();
  hands[1].stick_x = 1.0;
  EXPECT_EQ(steering_of(hands), (Steering{.yaw = 1.0}));
  hands[1].stick_x = 0.0;
  hands[1].stick_y = -1.0;
  EXPECT_EQ(steering_of(hands), (Steering{.pitch = -1.0}));
}

TEST(HeadsetPads, FlyAndTurnWithTheStickOfASingleController) {
  for (const std::size_t hand : {0U, 1U}) {
    HeadsetHands hands;
    hands[hand].connected = true;
    hands[hand].stick_y = 1.0;
    EXPECT_EQ(steering_of(hands), (Steering{.forward = 1.0}));
    hands[hand].stick_y = 0.0;
    hands[hand].stick_x = -1.0;
    EXPECT_EQ(steering_of(hands), (Steering{.yaw = -1.0}));
  }
}

TEST(HeadsetPads, RiseAndSinkWithTheGrips) {
  HeadsetHands hands = two_controllers();
  hands[0].grip = 1.0;
  EXPECT_EQ(steering_of(hands), (Steering{.up = -1.0}));
  hands[0].grip = 0.0;
  hands[1].grip = 1.0;
  EXPECT_EQ(steering_of(hands), (Steering{.up = 1.0}));
}

TEST(HeadsetPads, HurryWithTheRightTriggerAndLetGoWithTheLeftOne) {
  HeadsetHands hands = two_controllers();
  hands[1].trigger = 1.0;
  EXPECT_EQ(steering_of(hands), (Steering{.faster = 1.0}));
  EXPECT_THAT(actions_of(hands), IsEmpty());
  hands[1].trigger = 0.0;
  hands[0].trigger = 1.0;
  EXPECT_THAT(actions_of(hands), ElementsAre(KeyAction::let_go));
}

TEST(HeadsetPads, HaveTheButtonsOfAPadByPosition) {
  const auto action_of = [](int hand, bool HeadsetHand::*part) {
    HeadsetHands hands = two_controllers();
    hands[static_cast<std::size_t>(hand)].*part = true;
    return actions_of(hands);
  };
  EXPECT_THAT(action_of(1, &HeadsetHand::lower), ElementsAre(KeyAction::fly));
  EXPECT_THAT(action_of(1, &HeadsetHand::upper), ElementsAre(KeyAction::return_to_path));
  EXPECT_THAT(action_of(0, &HeadsetHand::lower), ElementsAre(KeyAction::next_flight_mode));
  EXPECT_THAT(action_of(0, &HeadsetHand::upper), ElementsAre(KeyAction::next_observer));
  EXPECT_THAT(action_of(0, &HeadsetHand::stick), ElementsAre(KeyAction::reverse_orbit));
  EXPECT_THAT(action_of(1, &HeadsetHand::stick), ElementsAre(KeyAction::reset));
}

TEST(HeadsetPads, KeepTheMenuButtonsForRecentering) {
  HeadsetHands hands = two_controllers();
  hands[0].menu = true;
  hands[1].menu = true;
  EXPECT_EQ(pad_of(hands), PadState());
}

TEST(HeadsetPads, IgnoreAStickNearItsCenter) {
  HeadsetHands hands = two_controllers();
  hands[0].stick_x = 0.1;
  hands[1].stick_y = -0.1;
  EXPECT_EQ(pad_of(hands), PadState());
}

TEST(HeadsetPads, HoldATriggerUntilItIsReleasedFarEnough) {
  HeadsetHands hands = two_controllers();
  PadState pad;
  const auto pulled_at = [&](double value) {
    hands[0].trigger = value;
    hands[0].grip = value;
    pad = pad_of(hands, pad);
    EXPECT_EQ(pad.pressed(PadButton::left_trigger), pad.pressed(PadButton::left_shoulder));
    return pad.pressed(PadButton::left_trigger);
  };
  EXPECT_FALSE(pulled_at(0.45));
  EXPECT_TRUE(pulled_at(0.6));
  EXPECT_TRUE(pulled_at(0.45));
  EXPECT_FALSE(pulled_at(0.35));
}

TEST(HeadsetPads, MoveWithAPinchOfHandsWithoutSticks) {
  HeadsetHands hands = two_tracked_hands();
  hands[1].trigger = 1.0;
  EXPECT_EQ(steering_of(hands), (Steering{.forward = 1.0}));
  hands[0].trigger = 1.0;
  EXPECT_EQ(steering_of(hands), Steering()) << "both";
  hands[1].trigger = 0.0;
  EXPECT_EQ(steering_of(hands), (Steering{.forward = -1.0}));
  EXPECT_THAT(actions_of(hands), IsEmpty()) << "let_go";
}

TEST(HeadsetPad, IsOnePadMoreWhileAControllerIsConnected) {
  HeadsetPad pad;
  PadSnapshot none;
  pad.add_to(none, {});
  EXPECT_THAT(none.pads, IsEmpty());
  HeadsetHands hands;
  hands[1].connected = true;
  PadSnapshot one;
  one.pads.resize(1);
  pad.add_to(one, hands);
  ASSERT_EQ(one.pads.size(), 2U);
  EXPECT_EQ(one.pads[1].identity->name, "headset controllers");
  EXPECT_TRUE(one.pads[1].connected);
}

TEST(HeadsetPad, CountsAPressOnceAndRemembersWhenItCame) {
  HeadsetPad pad;
  const auto after = [&](double time_s, const HeadsetHands& hands) {
    PadSnapshot pads;
    pads.time_s = time_s;
    pad.add_to(pads, hands);
    return pads;
  };
  HeadsetHands pressed = two_controllers();
  pressed[1].lower = true;
  EXPECT_LT(after(1.0, two_controllers()).last_input_s(), 0.0);
  EXPECT_EQ(after(2.0, pressed).presses(PadButton::south), 1);
  const PadSnapshot held = after(3.0, pressed);
  EXPECT_EQ(held.presses(PadButton::south), 0);
  EXPECT_EQ(held.last_input_s(), 2.0);
  EXPECT_TRUE(held.merged().pressed(PadButton::south));
}

}  // namespace
}  // namespace ergodome
