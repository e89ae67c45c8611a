#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/pads/pad_hub.h"
#include "tests/app/pads/fixtures.h"

// A pad hub that plays recorded pads in simulated time, for tests.
namespace ergodome::test {

inline constexpr double frame_s = 1.0 / 60.0;

//! Returns a USB report of a DualShock 4 with the given position of the left stick and face
//! buttons.
inline std::string ds4(int left_x = 128, int left_y = 128, int face = 0) {
  std::vector<std::uint8_t> report(64);
  report[0] = 1;
  report[1] = static_cast<std::uint8_t>(left_x);
  report[2] = static_cast<std::uint8_t>(left_y);
  report[3] = report[4] = 128;
  report[5] = static_cast<std::uint8_t>(8 | face);
  std::string hex;
  for (const std::uint8_t byte : report) {
    constexpr const char* digits = "0123456789abcdef";
    hex += digits[byte >> 4U];
    hex += digits[byte & 15U];
  }
  return hex;
}

inline std::string device(const std::string& path, const std::string& more = "") {
  return "[[device]]\npath = \"" + path + "\"\nvid = \"054c\"\npid = \"09cc\"\nusage = \"1:5\"\nname = \"Pad\"\n" +
         more;
}

inline std::string at(int t_ms, const std::string& what) {
  std::string event = "[[device.event]]\nt_ms = ";
  event += std::to_string(t_ms);
  return event + "\n" + what + "\n";
}

inline std::string report_at(int t_ms, const std::string& hex, const std::string& more = "") {
  return at(t_ms, "hex = \"" + hex + "\"\n" + more);
}

//! A pad hub whose time is set by the test.
class PadHubTest : public testing::Test {
 protected:
  void play(const std::string& text, PadSettings settings = {}) {
    auto player = std::make_unique<FixturePlayer>(parse_hid_fixture(text, "test.toml"), [this] { return now_s_; });
    player_ = player.get();
    hub_ = std::make_unique<PadHub>(std::move(player), std::move(settings), [this] { return now_s_; });
  }

  //! Polls the hub once per frame until the time `t_s`, and then returns a snapshot.
  PadSnapshot frame_at(double t_s) {
    for (; now_s_ + frame_s < t_s; now_s_ += frame_s) {
      hub_->poll();
    }
    now_s_ = t_s;
    hub_->poll();
    return hub_->snapshot();
  }

  double now_s_ = 0.0;
  FixturePlayer* player_ = nullptr;
  std::unique_ptr<PadHub> hub_;
};

}  // namespace ergodome::test
