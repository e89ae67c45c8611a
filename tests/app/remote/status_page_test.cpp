#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <thread>

#include "app/remote/remote_control.h"
#include "tests/support/fake_player.h"
#include "tests/support/web_driver.h"

namespace ergodome {
namespace {

using test::becomes_true;

//! Opens the page in a browser that all tests share.
class StatusPage : public testing::Test {
 protected:
  static void SetUpTestSuite() { browser = test::WebDriver::start(why_not).release(); }
  static void TearDownTestSuite() {
    delete browser;
    browser = nullptr;
  }

  void SetUp() override {
    if (browser == nullptr) {
      GTEST_SKIP() << "no browser: " << why_not;
    }
    serve(0);
    browser->set_size(1280, 800);
    browser->open("http://" + remote_->web_address()->text() + "/");
    ASSERT_TRUE(becomes_true([&] { return shows("#connection", "Connected") && shows("#title", "Once around"); }));
  }

  void TearDown() override { remote_.reset(); }

  void serve(int port) {
    RemoteOptions options;
    options.web_port = port;
    remote_ = std::make_unique<RemoteControl>(options, player_.commands, player_.board, log_, OscListeners());
  }

  static bool has(const std::string& selector) {
    return browser->run("return document.querySelector(arguments[0]) !== null", {selector});
  }
  static bool shows(const std::string& selector, const std::string& text) {
    return has(selector) && browser->text(selector).find(text) != std::string::npos;
  }

  //! Waits until the player's status fulfills a condition; returns false after a time limit.
  bool player_becomes(const std::function<bool(const PlayerStatus&)>& condition) {
    return becomes_true([&] { return condition(player_.board.read()); });
  }

  //! Saves a screenshot of the page to the folder ERGODOME_SCREENSHOTS, for inspection by eye.
  static void take_picture(const std::string& name) {
    if (const char* const folder = std::getenv("ERGODOME_SCREENSHOTS")) {
      browser->screenshot(std::filesystem::path(folder) / ("status-page-" + name + ".png"));
    }
  }

  inline static test::WebDriver* browser = nullptr;
  inline static std::string why_not;
  test::FakePlayer player_;
  std::shared_ptr<LogRing> log_ = std::make_shared<LogRing>();
  std::unique_ptr<RemoteControl> remote_;
};

TEST_F(StatusPage, PlaysAndPauses) {
  browser->click("#toggle_pause");
  EXPECT_TRUE(player_becomes([](const PlayerStatus& status) { return status.playing && status.time_s > 0.2; }));
  EXPECT_TRUE(becomes_true([&] { return shows("#toggle_pause", "Pause") && !shows("#time", "0:00.0"); }));
  browser->click("#toggle_pause");
  EXPECT_TRUE(player_becomes([](const PlayerStatus& status) { return !status.playing; }));
}

TEST_F(StatusPage, SeeksWhereTheBarIsDragged) {
  browser->drag("#seek", 0.1, 0.5);
  EXPECT_TRUE(player_becomes([](const PlayerStatus& status) { return status.time_s > 55.0 && status.time_s < 65.0; }));
  EXPECT_TRUE(becomes_true([&] { return shows("#chapters [aria-current]", "The far side"); }));
}

TEST_F(StatusPage, SeeksByTheArrowKeysWithinTheBar) {
  browser->run("document.querySelector('#seek').focus()");
  browser->press("\uE014");
  browser->press("\uE014");
  EXPECT_TRUE(player_becomes([](const PlayerStatus& status) { return status.time_s == 2.0; }));
}

TEST_F(StatusPage, ChangesTheExposure) {
  browser->drag("#exposure", 0.5, 0.7);
  // The knob of the slider is as wide as a finger, so dragging by 0.2 of the slider's width changes
  // the exposure by slightly more than 0.2 of its range.
  EXPECT_TRUE(player_becomes(
      [](const PlayerStatus& status) { return status.exposure_stops > 1.9 && status.exposure_stops < 2.8; }));
  EXPECT_TRUE(becomes_true([&] { return shows("#exposure-value", "+2."); }));
}

TEST_F(StatusPage, LeavesAFaderUnderTheFinger) {
  browser->drag("#exposure", 0.5, 0.8, false);
  ASSERT_TRUE(player_becomes([](const PlayerStatus& status) { return status.exposure_stops > 2.0; }));
  // Another client changes the exposure to -4 while the finger is still on the slider. The new
  // title shows that the page has received this status.
  player_.change([](PlayerStatus& status) {
    status.exposure_stops = -4.0;
    status.title = "Turned back";
  });
  ASSERT_TRUE(becomes_true([&] { return shows("#title", "Turned back"); }));
  EXPECT_TRUE(shows("#exposure-value", "+"));
  browser->release();
  EXPECT_TRUE(becomes_true([&] { return shows("#exposure-value", "\u22124.0"); }));
}

TEST_F(StatusPage, GoesToAChapterThatIsTouched) {
  browser->click("#chapters li:nth-child(3) button");
  EXPECT_TRUE(player_becomes([](const PlayerStatus& status) { return status.time_s == 90.0; }));
}

TEST_F(StatusPage, ShowsAPadThatIsPluggedInAndUsed) {
  ASSERT_TRUE(shows("#pads-card", "No pad is connected"));
  player_.change([](PlayerStatus& status) { status.pads = {{"DualSense", "Bluetooth", false}}; });
  EXPECT_TRUE(becomes_true([&] { return shows("#pads li", "DualSense"); }));
  player_.change([](PlayerStatus& status) { status.pads[0].active = true; });
  EXPECT_TRUE(becomes_true([&] { return shows("#pads li.active", "in use"); }));
}

TEST_F(StatusPage, ShowsAProblemAndTheLogAsTextAlone) {
  player_.change([](PlayerStatus& status) { status.problem = "<b>show.toml:7</b>: unknown key"; });
  log_->push(spdlog::level::warn, "<script>document.title = 'taken'</script>", std::chrono::system_clock::now());
  EXPECT_TRUE(becomes_true([&] { return shows("#problem", "<b>show.toml:7</b>"); }));
  EXPECT_TRUE(becomes_true([&] { return shows("#log .warning", "<script>"); }));
  EXPECT_EQ(browser->run("return document.title"), "Ergodome");
}

TEST_F(StatusPage, TogglesAndButtonsReachThePlayer) {
  for (const char* id : {"#blackout", "#captions", "#free_flight", "#loop", "[data-speed='2']"}) {
    browser->click(id);
  }
  browser->click("#languages button:nth-child(2)");
  EXPECT_TRUE(player_becomes([](const PlayerStatus& status) {
    return status.blackout && !status.captions && status.free_flight && !status.loop && status.speed == 2.0 &&
           status.language == "de";
  }));
  EXPECT_TRUE(becomes_true([&] { return shows("#languages [aria-pressed='true']", "de"); }));
}

TEST_F(StatusPage, TellsOfALostConnectionAndComesBack) {
  const int port = remote_->web_address()->port();
  remote_.reset();
  EXPECT_TRUE(becomes_true([&] { return shows("#connection", "Connection lost"); }));
  take_picture("lost");
  serve(port);
  EXPECT_TRUE(becomes_true([&] { return browser->text("#connection") == "Connected"; }));
  browser->click("#toggle_pause");
  EXPECT_TRUE(player_becomes([](const PlayerStatus& status) { return status.playing; }));
}

TEST_F(StatusPage, SaysWhatThePlayerRefused) {
  // Simulates the answer of a player whose show no longer has the chapter that the page still
  // lists.
  browser->run(
      "fetch = (_, options) => Promise.resolve(new Response('{\"error\": \"no such chapter\"}', {status: 400}))");
  browser->click("#chapters li:nth-child(1) button");
  EXPECT_TRUE(becomes_true([&] { return shows("#refused", "no such chapter"); }));
}

TEST_F(StatusPage, ShowsTheLostClockAndDisablesWhatItRefuses) {
  EXPECT_EQ(browser->text("#clock"), "internal");
  EXPECT_FALSE(browser->run("return document.querySelector('#toggle_pause').disabled"));
  player_.change([](PlayerStatus& status) {
    status.follows = "MIDI time code";
    status.clock_state = "running_on";
    status.clock_silence_s = 0.7;
  });
  EXPECT_TRUE(becomes_true([&] { return shows("#clock", "MIDI time code: signal lost 1 s ago, the show runs on"); }));
  EXPECT_TRUE(becomes_true([&] { return shows("#news", "MIDI time code: signal lost, the show runs on"); }));
  player_.change([](PlayerStatus& status) {
    status.clock_state = "stopped";
    status.clock_silence_s = 3.2;
  });
  EXPECT_TRUE(
      becomes_true([&] { return shows("#clock", "MIDI time code: signal lost 3 s ago, the show has stopped"); }));
  const nlohmann::json reasons = browser->run(R"(
    const ids = '#seek, #previous_chapter, #step_back, #toggle_pause, #step_on, #next_chapter';
    return [...document.querySelectorAll(`${ids}, [data-speed], #chapters button`)]
      .map((control) => control.disabled && control.title);)");
  EXPECT_EQ(reasons.size(), 15U);
  for (const nlohmann::json& reason : reasons) {
    EXPECT_EQ(reason, "Unavailable: the show's time follows MIDI time code");
  }
  for (const char* const allowed : {"#blackout", "#captions", "#exposure", "#mute", "#free_flight"}) {
    EXPECT_FALSE(browser->run("return document.querySelector(arguments[0]).disabled", {allowed})) << allowed;
  }
  take_picture("clock-lost");
  player_.change([](PlayerStatus& status) { status.clock_state = "following"; });
  EXPECT_TRUE(becomes_true([&] { return shows("#clock", "MIDI time code: the show follows, time is stopped"); }));
  player_.change([](PlayerStatus& status) {
    status.follows = "";
    status.clock_state = "own";
  });
  EXPECT_TRUE(becomes_true([&] { return !browser->run("return document.querySelector('#seek').disabled"); }));
  EXPECT_EQ(browser->run("return document.querySelector('#toggle_pause').title"), "Play or pause (space bar)");
}

TEST_F(StatusPage, ShowsHowMuchOfTheShowIsLeft) {
  player_.change([](PlayerStatus& status) { status.time_s = 47.0; });
  EXPECT_TRUE(becomes_true([&] { return browser->text("#rest") == "1:13 left of 2:00"; }));
  player_.change([](PlayerStatus& status) { status.duration_s = 0.0; });
  EXPECT_TRUE(becomes_true([&] { return browser->text("#rest").empty(); }));
  EXPECT_TRUE(
      browser->run("return document.querySelector('#seek').title === 'Unavailable: this show has no duration'"));
}

TEST_F(StatusPage, MutesAndComesBackToTheVolumeBefore) {
  player_.change([](PlayerStatus& status) { status.volume = 0.4; });
  ASSERT_TRUE(becomes_true([&] { return shows("#volume-value", "40 %"); }));
  browser->click("#mute");
  EXPECT_TRUE(player_becomes([](const PlayerStatus& status) { return status.volume == 0.0; }));
  EXPECT_TRUE(becomes_true([&] { return shows("#mute[aria-pressed='true']", "Mute"); }));
  // The pause is longer than the time for which the page shows a requested value that the player
  // has not confirmed.
  std::this_thread::sleep_for(std::chrono::milliseconds(1700));
  browser->click("#mute");
  EXPECT_TRUE(player_becomes([](const PlayerStatus& status) { return status.volume == 0.4; }));
}

TEST_F(StatusPage, KeepsBlackoutAwayFromTheOtherControls) {
  for (const auto& [width, height] : {std::pair{390, 844}, {768, 1024}, {1280, 800}}) {
    browser->set_size(width, height);
    const double nearest_px = browser->run(R"(
      const dark = document.querySelector('#blackout').getBoundingClientRect();
      return Math.min(...[...document.querySelectorAll('button, input')].filter((other) => other.id !== 'blackout').map((other) => {
        const box = other.getBoundingClientRect();
        const across = Math.max(0, box.left - dark.right, dark.left - box.right);
        return Math.hypot(across, Math.max(0, box.top - dark.bottom, dark.top - box.bottom));
      }));)");
    EXPECT_GE(nearest_px, 32.0) << width;
  }
}

TEST_F(StatusPage, AnnouncesWhatChanges) {
  player_.change([](PlayerStatus& status) { status.language = "de"; });
  EXPECT_TRUE(becomes_true([&] { return shows("#news[aria-live='polite']", "Language: German"); }));
  player_.change([](PlayerStatus& status) { status.time_s = 41.0; });
  EXPECT_TRUE(becomes_true([&] { return shows("#news", "Chapter: The far side"); }));
  player_.change([](PlayerStatus& status) { status.blackout = true; });
  EXPECT_TRUE(becomes_true([&] { return shows("#news", "Blackout"); }));
}

TEST_F(StatusPage, EveryControlHasANameATooltipAndRoomForAFinger) {
  browser->set_size(390, 844);
  const nlohmann::json bad = browser->run(R"(
    return [...document.querySelectorAll('button, input')].filter((control) => {
      const box = control.getBoundingClientRect();
      const named = control.getAttribute('aria-label') || control.textContent.trim() || (control.labels && control.labels.length);
      return control.offsetParent && (!named || !control.title || box.height < 44 || box.width < 44);
    }).map((control) => control.outerHTML);)");
  EXPECT_EQ(bad, nlohmann::json::array());
}

TEST_F(StatusPage, FitsEveryScreen) {
  player_.change([](PlayerStatus& status) {
    status.pads = {{"DualSense Wireless Controller", "Bluetooth", true}, {"SpaceMouse Pro", "USB", false}};
    status.problem = "once-around.toml:31: camera.key[4].easing is not a known key; did you mean 'ease'?";
    status.dropped_frames = 3;
    status.baseline_used = status.baseline;
    status.sound = "Planetarium 5.1";
    status.playing = true;
    status.time_s = 47.0;
  });
  log_->push(spdlog::level::info, "show 'Once around' is loaded", std::chrono::system_clock::now());
  log_->push(spdlog::level::warn, "once-around.toml: the edit is broken; the running version stays",
             std::chrono::system_clock::now());
  ASSERT_TRUE(becomes_true([&] { return shows("#pads", "SpaceMouse") && shows("#log", "stays"); }));
  for (const auto& [width, height] : {std::pair{390, 844}, {768, 1024}, {1280, 800}}) {
    browser->set_size(width, height);
    EXPECT_EQ(browser->run("return document.documentElement.scrollWidth"), width) << "a page that scrolls sideways";
    take_picture(std::to_string(width));
  }
}

}  // namespace
}  // namespace ergodome
