#include "app/remote/common/log_ring.h"

#include <gtest/gtest.h>
#include <spdlog/logger.h>

#include <nlohmann/json.hpp>

#include "app/remote/web/web_json.h"

namespace ergodome {
namespace {

void push(LogRing& ring, const std::string& text) {
  ring.push(spdlog::level::info, text, std::chrono::system_clock::time_point());
}

TEST(LogRing, KeepsTheLastLinesAndTheirNumbers) {
  LogRing ring(3);
  for (const char* text : {"a", "b", "c", "d", "e"}) {
    push(ring, text);
  }
  const std::vector<LogLine> lines = ring.after(0);
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines.front().text, "c");
  EXPECT_EQ(lines.front().number, 3U);
  EXPECT_EQ(ring.after(4).size(), 1U);
  EXPECT_TRUE(ring.after(5).empty());
}

TEST(LogRing, CutsLongLinesBetweenCharacters) {
  LogRing ring;
  // The limit of 1000 bytes is not a multiple of the three bytes of each character, so a naive cut
  // would split a character.
  std::string text;
  for (int i = 0; i < 500; ++i) {
    text += "\u2013";
  }
  push(ring, text);
  EXPECT_EQ(ring.after(0).front().text.size(), 999U);
}

TEST(LogRing, KeepsAMessageOnOneLine) {
  LogRing ring;
  push(ring, "two\nlines\x1b[31m");
  EXPECT_EQ(ring.after(0).front().text, "two lines [31m");
}

TEST(LogRing, IsFedBySpdlog) {
  const auto ring = std::make_shared<LogRing>();
  spdlog::logger log("test", log_ring_sink(ring));
  log.warn("frame {} took long", 7);
  const std::vector<LogLine> lines = ring->after(0);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].text, "frame 7 took long");
  EXPECT_EQ(nlohmann::json::parse(log_json(lines)).at(0).at("level"), "warning");
}

}  // namespace
}  // namespace ergodome
