#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "app/player/player.h"
#include "content/show/reading/show_reader.h"

namespace ergodome {
namespace {

//! A fake headset: its controllers stay in one state, and its first frame ends the player. It keeps
//! the last caption, which names the flight mode unless the camera is on the show's path.
class FakeHeadset : public DisplayOutput {
 public:
  FakeHeadset(const HeadsetHands& hands, std::string& caption) : hands_(hands), caption_(caption) {}

  [[nodiscard]] OutputWish wish() override { return {}; }
  void take(OutputFrame& /*frame*/) override { taken_ = true; }
  void set_light(double /*light*/) override {}
  void show() override { closed_ = closed_ || taken_; }
  [[nodiscard]] bool closed() const override { return closed_; }
  void close() override { closed_ = true; }
  [[nodiscard]] std::optional<HeadsetHands> hands() override { return hands_; }
  void set_text(PanelPosition position, const std::string& text) override {
    if (position == PanelPosition::bottom_middle) {
      caption_ = text;
    }
  }

 private:
  HeadsetHands hands_;
  std::string& caption_;
  bool taken_ = false;
  bool closed_ = false;
};

//! Plays a show with controllers in one state; returns whether the camera left the show's path.
bool flies(const HeadsetHands& hands, bool guide) {
  const Show played = parse_show("[hole]\nspin = 0.9\n[[camera.key]]\nr = 12\n", "controllers.toml");
  PlayOptions options;
  options.size_px = 32;
  options.guide = guide;
  options.pad_fixture = ERGODOME_TEST_DATA_DIR "/hid/mouse_and_keyboard.toml";
  options.services.sound = false;
  options.services.log_on_terminal = false;
  options.load = [&](const std::string&) -> const Show& { return played; };
  options.for_seconds = 60.0;  // if no frame comes
  const auto make = [](const Show& shown) { return std::make_shared<ShowRenderer>(shown, Backend::cpu); };
  std::string caption;
  Player(played, make, std::make_unique<FakeHeadset>(hands, caption), options).run();
  return !caption.empty();
}

TEST(HeadsetControllers, FlyLikeAPad) {
  HeadsetHands hands;
  hands[1].connected = true;
  hands[1].stick_x = 1.0;
  EXPECT_TRUE(flies(hands, false));
}

TEST(HeadsetControllers, OnlyMoveForwardAndBackInGuideMode) {
  HeadsetHands hands;
  hands[0].connected = true;
  hands[0].stick_x = 1.0;
  EXPECT_FALSE(flies(hands, true));
  hands[0].stick_x = 0.0;
  hands[0].stick_y = 1.0;
  EXPECT_TRUE(flies(hands, true));
}

}  // namespace
}  // namespace ergodome
