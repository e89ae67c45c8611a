#include "app/player/player_inputs.h"

#include <GLFW/glfw3.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/player/outputs/headset_pad.h"

namespace ergodome {
namespace {

using testing::IsEmpty;

//! The inputs of a show that a guide leads.
class GuideMode : public testing::Test {
 protected:
  GuideMode() { inputs_.set_lock(InputLock::guide); }

  PlayerInput after(const std::vector<WindowEvent>& events) { return inputs_.gather(events, {}, 1e-3); }
  PlayerInput after(const PadState& pad) {
    PadSnapshot pads;
    pads.pads.emplace_back();
    pads.pads[0].state = pad;
    return inputs_.gather({}, pads, 1e-3);
  }

  PlayerInputs inputs_{Controls()};
};

TEST_F(GuideMode, KeepsForwardAndBackOfAPad) {
  PadState pad;
  pad.axes[static_cast<std::size_t>(PadAxis::left_y)] = 0.5F;
  EXPECT_EQ(after(pad).steering.rates, (Steering{.forward = 0.5}));
  pad.axes[static_cast<std::size_t>(PadAxis::left_y)] = -1.0F;
  EXPECT_EQ(after(pad).steering.rates, (Steering{.forward = -1.0}));
}

TEST_F(GuideMode, DropsEverythingElseOfAPad) {
  PadState pad;
  pad.axes.fill(1.0F);
  pad.axes[static_cast<std::size_t>(PadAxis::left_y)] = 0.0F;
  pad.axes[static_cast<std::size_t>(PadAxis::move_forward)] = 0.0F;
  pad.buttons.set();
  const PlayerInput input = after(pad);
  EXPECT_EQ(input.steering.rates, Steering());
  EXPECT_THAT(input.actions, IsEmpty());
  EXPECT_TRUE(inputs_.touched()) << "a visitor is there";
}

TEST_F(GuideMode, KeepsForwardAndBackOfTheControllersOfAHeadset) {
  HeadsetHands hands;
  hands[0] = {.connected = true, .stick_x = 0.6, .stick_y = 0.8, .grip = 1.0, .lower = true};
  hands[1] = {.connected = true, .stick_x = 1.0, .trigger = 1.0, .upper = true};
  PadSnapshot pads;
  HeadsetPad().add_to(pads, hands);
  const PlayerInput input = inputs_.gather({}, pads, 1e-3);
  EXPECT_GT(input.steering.rates.forward, 0.0);
  EXPECT_EQ(input.steering.rates, (Steering{.forward = input.steering.rates.forward}));
  EXPECT_THAT(input.actions, IsEmpty());
}

TEST_F(GuideMode, KeepsForwardAndBackOfTheKeys) {
  using Kind = WindowEvent::Kind;
  const PlayerInput input = after({{Kind::key_down, GLFW_KEY_S}, {Kind::key_down, GLFW_KEY_D}});
  EXPECT_EQ(input.steering.rates, (Steering{.forward = -1.0}));
  EXPECT_THAT(after({{Kind::key_down, GLFW_KEY_SPACE}, {Kind::key_down, GLFW_KEY_ESCAPE}}).actions, IsEmpty());
}

TEST_F(GuideMode, DropsTheMouse) {
  using Kind = WindowEvent::Kind;
  const PlayerInput input =
      after({{Kind::button_down, 0, 0.0, 0.0}, {Kind::pointer, 0, 20.0, 10.0}, {Kind::scroll, 0, 0.0, 2.0}});
  EXPECT_EQ(input.steering.amounts, Steering());
  EXPECT_EQ(input.steering.rates, Steering());
}

TEST_F(GuideMode, KeepsTheOperatorsChord) {
  using Kind = WindowEvent::Kind;
  after({{Kind::key_down, GLFW_KEY_LEFT_CONTROL}, {Kind::key_down, GLFW_KEY_LEFT_ALT}, {Kind::key_down, GLFW_KEY_Q}});
  EXPECT_TRUE(inputs_.chord_held());
}

}  // namespace
}  // namespace ergodome
