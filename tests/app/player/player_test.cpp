#include "app/player/player.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "content/show/reading/show_reader.h"
#include "kernels/projection/make_projection.h"

namespace ergodome {
namespace {

//! A fake output without a window. It keeps the pictures of its first frame, then asks the player
//! to end.
class HeadlessOutput : public DisplayOutput {
 public:
  struct Kept {
    std::vector<Picture> eyes;
    EyeGrid grid;
    int shown = 0;  //!< number of calls of show() after the first frame
    HeadsetSettings headset;
  };

  HeadlessOutput(std::vector<OutputEye> eyes, std::shared_ptr<Kept> kept)
      : eyes_(std::move(eyes)), kept_(std::move(kept)) {}

  [[nodiscard]] OutputWish wish() override {
    OutputWish wish;
    wish.eyes = eyes_;
    return wish;
  }
  void take(OutputFrame& frame) override {
    kept_->grid = frame.eye_grid;
    kept_->eyes = {frame.picture};
    if (frame.right_eye) {
      kept_->eyes.push_back(*frame.right_eye);
    }
  }
  void set_light(double /*light*/) override {}
  void set_headset(const HeadsetSettings& settings) override { kept_->headset = settings; }
  void show() override { kept_->shown += kept_->eyes.empty() ? 0 : 1; }
  [[nodiscard]] bool closed() const override { return closed_ || kept_->shown > 0; }
  void close() override { closed_ = true; }

 private:
  std::vector<OutputEye> eyes_;
  std::shared_ptr<Kept> kept_;
  bool closed_ = false;
};

class PlayerOutputs : public testing::Test {
 protected:
  PlayerOutputs() : show_(parse_show(text, "outputs.toml")) {}

  //! Plays until a fake output with the given eyes has received a frame; returns that frame.
  HeadlessOutput::Kept play(const std::vector<OutputEye>& eyes) {
    auto kept = std::make_shared<HeadlessOutput::Kept>();
    PlayOptions options;
    options.size_px = 32;
    options.pad_fixture = ERGODOME_TEST_DATA_DIR "/hid/flight.toml";
    options.services.sound = false;
    options.services.log_on_terminal = false;
    options.load = [this](const std::string&) { return show_; };
    options.for_seconds = 60.0;  // time limit, in case no frame comes
    const auto make = [](const Show& show) { return std::make_shared<ShowRenderer>(show, Backend::cpu); };
    Player(show_, make, std::make_unique<HeadlessOutput>(eyes, kept), options).run();
    return *kept;
  }

  static constexpr const char* text =
      "[hole]\nspin = 0.9\n[[camera.key]]\nr = 12\n[sky]\nmap = \"milky_way\"\n"
      "[view]\nprojection = \"pinhole\"\nfov_deg = 60\n"
      "[stereo]\nlayout = \"side_by_side\"\nbaseline = 0.2\n";
  Show show_;
};

TEST_F(PlayerOutputs, GetTheEyesOfTheShowUnlessTheyWantOthers) {
  const HeadlessOutput::Kept kept = play({});
  ASSERT_EQ(kept.eyes.size(), 2U);
  EXPECT_EQ(kept.grid.columns, 2);
  EXPECT_EQ(kept.eyes[0].width, 32);
}

TEST_F(PlayerOutputs, GetTheHeadsetSettingsOfTheShow) {
  show_.headset.vignette = 0.25;
  EXPECT_EQ(play({}).headset, show_.headset);
}

TEST_F(PlayerOutputs, GetTheFrustaThatTheyWant) {
  // The two eyes of a headset, each with a frustum that is wider towards its outer side.
  const Projection left = make_frustum_projection(24, 20, {-1.2, 0.9, 1.0, -1.1});
  const Projection right = make_frustum_projection(24, 20, {-0.9, 1.2, 1.0, -1.1});
  const glm::dquat turn = glm::angleAxis(0.3, glm::dvec3(0.0, 1.0, 0.0));
  const HeadlessOutput::Kept kept = play({{-0.5, turn, left}, {0.5, turn, right}});
  ASSERT_EQ(kept.eyes.size(), 2U);
  ShowRenderer renderer(show_, Backend::cpu);
  CameraPose head = camera_pose(show_, 0.0);
  head.orientation = head.orientation * turn;
  const Picture pictures[2] = {renderer.render_eye(head, -0.1, left, ViewMode::sky),
                               renderer.render_eye(head, 0.1, right, ViewMode::sky)};
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(kept.eyes[i].width, 24);
    EXPECT_EQ(kept.eyes[i].height, 20);
    EXPECT_TRUE(std::ranges::equal(kept.eyes[i].rgba, pictures[i].rgba)) << "eye " << i;
  }
  EXPECT_FALSE(std::ranges::equal(kept.eyes[0].rgba, kept.eyes[1].rgba));
}

TEST(PlayerSessionForOutputs, RendersAPlayingShowForTheTimeWhenItIsSeen) {
  MonotonicTime now = std::chrono::seconds(1000);
  const Show show = parse_show("duration_s = 9\n[hole]\nspin = 0.9\n[[camera.key]]\nr = 4\n", "delay.toml");
  PlayerSession session(show, {.language = "en", .source = [&] { return now; }});
  PlayerInput input;
  input.display_delay_s = 0.25;
  now += std::chrono::seconds(2);
  session.advance(input);
  EXPECT_NEAR(session.frame().time_s, 2.25, 1e-9);
  input.actions = {KeyAction::pause};
  session.advance(input);
  EXPECT_NEAR(session.frame().time_s, 2.0, 1e-9);
  now += std::chrono::seconds(2);
  session.advance(input);
  now += std::chrono::seconds(60);
  input.actions.clear();
  session.advance(input);
  EXPECT_LE(session.frame().time_s, 9.0);
}

}  // namespace
}  // namespace ergodome
