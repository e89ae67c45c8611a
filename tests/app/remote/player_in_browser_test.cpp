#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <sstream>

#include "tests/support/child_process.h"
#include "tests/support/fake_player.h"
#include "tests/support/folder_test.h"
#include "tests/support/web_driver.h"

namespace ergodome {
namespace {

using test::becomes_true;

constexpr const char* show_text = R"(
title = "Two halves"
duration_s = 60
[camera]
[[camera.key]]
t_s = 0
r = 20
[[camera.key]]
t_s = 60
r = 12
[sky]
map = "grid"
[view]
size_px = 64
[[chapter]]
t_s = 0
title = "Near"
[[chapter]]
t_s = 30
title = "Nearer"
)";

//! Runs the player on a virtual display, with a pad that nobody touches, and controls it through a
//! browser.
class PlayerInABrowser : public test::FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    std::string why_not = "no virtual display";
    if (std::system("command -v xvfb-run >/dev/null") == 0) {
      browser_ = test::WebDriver::start(why_not);
    }
    if (!browser_) {
      GTEST_SKIP() << "no browser: " << why_not;
    }
    std::ofstream(folder_ / "show.toml") << show_text;
    write_pad_at_rest();
    player_ = std::make_unique<test::ChildProcess>(std::vector<std::string>{
        "env", "ASAN_OPTIONS=detect_leaks=0", "XDG_CONFIG_HOME=" + folder_.string(), "xvfb-run", "-a", "-s",
        "-screen 0 640x480x24", ERGODOME_PROGRAM, "play", (folder_ / "show.toml").string(), "--no-sound", "--backend",
        "cpu", "--size", "64", "--web", "0", "--pad-fixture", (folder_ / "pad.toml").string()});
    const std::string greeting = player_->output_until("/\n", std::chrono::seconds(60));
    const std::size_t at = greeting.find("http://127.0.0.1:");
    ASSERT_NE(at, std::string::npos) << greeting;
    std::istringstream address(greeting.substr(at));
    std::string url;
    address >> url;
    browser_->set_size(1280, 800);
    browser_->open(url);
    ASSERT_TRUE(becomes_true([&] { return shows("#connection", "Connected") && shows("#title", "Two halves"); }));
  }

  void TearDown() override {
    browser_.reset();
    player_.reset();
    FolderTest::TearDown();
  }

  //! Writes the start of a pad's recording: only its first report, in which sticks and buttons are
  //! at rest.
  void write_pad_at_rest() const {
    std::ifstream recording(ERGODOME_TEST_DATA_DIR "/hid/flight.toml");
    std::ofstream pad(folder_ / "pad.toml");
    std::string line;
    for (int events = 0; std::getline(recording, line) && events < 2;) {
      events += line == "[[device.event]]" ? 1 : 0;
      if (events < 2) {
        pad << line << "\n";
      }
    }
  }

  bool shows(const std::string& selector, const std::string& text) {
    return browser_->run("return document.querySelector(arguments[0]) !== null", {selector}) &&
           browser_->text(selector).find(text) != std::string::npos;
  }

  //! Returns the position of the page's time slider [s].
  double time_s() {
    return std::stod(browser_->run("return document.querySelector('#seek').value").get<std::string>());
  }

  std::unique_ptr<test::WebDriver> browser_;
  std::unique_ptr<test::ChildProcess> player_;
};

TEST_F(PlayerInABrowser, IsToldOfAVersionWhoseSkyIsNotThereAndSeesTheRunningOne) {
  const std::string text = show_text;
  const auto save = [&](const std::string& title, const std::string& map) {
    const auto with = [](std::string of, const std::string& old, const std::string& other) {
      return of.replace(of.find(old), old.size(), other);
    };
    std::ofstream(folder_ / "show.toml") << with(with(text, "Two halves", title), "\"grid\"", "\"" + map + "\"");
  };
  save("Night", "night.png");
  EXPECT_TRUE(becomes_true([&] { return shows("#problem", "night.png"); }));
  EXPECT_TRUE(shows("#title", "Two halves"));
  save("Day", "grid");
  EXPECT_TRUE(becomes_true([&] { return shows("#title", "Day"); }));
  EXPECT_FALSE(shows("#problem", "night.png"));
}

TEST_F(PlayerInABrowser, PausesSeeksChangesTheExposureAndShowsThePad) {
  EXPECT_TRUE(becomes_true([&] { return shows("#pads li", "DualSense"); }));
  EXPECT_TRUE(becomes_true([&] { return shows("#toggle_pause", "Pause") && time_s() > 0.0; })) << "it plays";

  browser_->click("#toggle_pause");
  ASSERT_TRUE(becomes_true([&] { return shows("#toggle_pause", "Play"); }));

  browser_->drag("#seek", 0.1, 0.75);
  EXPECT_TRUE(becomes_true([&] { return shows("#chapters [aria-current]", "Nearer"); }));
  EXPECT_NEAR(time_s(), 45.0, 3.0);

  browser_->drag("#exposure", 0.5, 0.7);
  EXPECT_TRUE(becomes_true([&] { return shows("#exposure-value", "+2."); }));
}

}  // namespace
}  // namespace ergodome
