#include "app/remote/web/web_json.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "app/remote/common/command_rules.h"
#include "tests/support/errors.h"
#include "tests/support/fake_player.h"

namespace ergodome {
namespace {

using Kind = TransportCommand::Kind;
using test::error_of;

TransportCommand parsed_json(const std::string& text) { return parse_json_command(text, test::example_status()); }

std::string json_refusal(const std::string& text) {
  return error_of([&] { parsed_json(text); });
}

TEST(JsonCommand, ReadsNumbersTruthsAndTexts) {
  EXPECT_EQ(parsed_json(R"({"kind": "seek", "value": 12.5})"), (TransportCommand{Kind::seek, 12.5, ""}));
  EXPECT_EQ(parsed_json(R"({"kind": "loop", "value": true})"), (TransportCommand{Kind::loop, 1.0, ""}));
  EXPECT_EQ(parsed_json(R"({"kind": "blackout", "value": 0})"), (TransportCommand{Kind::blackout, 0.0, ""}));
  EXPECT_EQ(parsed_json(R"({"text": "de", "kind": "language"})"), (TransportCommand{Kind::language, 0.0, "de"}));
  EXPECT_EQ(parsed_json(R"({"kind": "play"})"), (TransportCommand{Kind::play, 0.0, ""}));
}

TEST(JsonCommand, StepsByOneWhereNoNumberIsGiven) {
  EXPECT_EQ(parsed_json(R"({"kind": "step"})"), (TransportCommand{Kind::step, 1.0, ""}));
  EXPECT_EQ(parsed_json(R"({"kind": "step", "value": -3})"), (TransportCommand{Kind::step, -3.0, ""}));
}

TEST(JsonCommand, FindsChaptersByTheirTitlesAndIndices) {
  EXPECT_EQ(parsed_json(R"({"kind": "chapter", "text": "the far side"})"), (TransportCommand{Kind::chapter, 1.0, ""}));
  EXPECT_EQ(parsed_json(R"({"kind": "chapter", "value": 2})"), (TransportCommand{Kind::chapter, 2.0, ""}));
  EXPECT_NE(json_refusal(R"({"kind": "chapter", "value": 3})"), "");
  EXPECT_NE(json_refusal(R"({"kind": "chapter", "text": "nowhere"})"), "");
}

TEST(JsonCommand, EveryRuleIsReachedByItsNameAndHasItsOwn) {
  std::set<std::string_view> names;
  std::set<Kind> kinds;
  for (const CommandRule& rule : command_rules()) {
    EXPECT_EQ(rule_of(rule.name), &rule);
    names.insert(rule.name);
    kinds.insert(rule.kind);
  }
  EXPECT_EQ(names.size(), command_rules().size());
  EXPECT_EQ(kinds.size(), static_cast<std::size_t>(Kind::reload) + 1);
}

TEST(JsonCommand, RefusesNumbersThatAreNoneOrTooLarge) {
  for (const char* value : {"1e999", "-1e999", "1e300", "-1", "NaN", "Infinity", "99999999999999999999999999", "\"5\"",
                            "null", "[5]", "{}"}) {
    EXPECT_NE(json_refusal(std::string(R"({"kind": "seek", "value": )") + value + "}"), "") << value;
  }
  EXPECT_NE(json_refusal(R"({"kind": "step", "value": 0.5})"), "");
  EXPECT_NE(json_refusal(R"({"kind": "loop", "value": 2})"), "");
}

TEST(JsonCommand, RefusesWhatIsNotOneFlatObject) {
  for (const char* text : {"", "{", "[]", "7", "null", "\"play\"", "{}", R"({"kind": 3})", R"({"kind": "play"} x)",
                           R"({"kind": "play", "more": 1})", R"({"kind": "play", "value": {"a": 1}})",
                           R"({"kind": "language", "value": 1, "text": "de"})", "\xff\xfe{\"kind\":\"play\"}"}) {
    EXPECT_NE(json_refusal(text), "") << text;
  }
}

TEST(JsonCommand, RefusesDepthAndLength) {
  const std::string deep = R"({"kind": "seek", "value": )" + std::string(1900, '[') + std::string(1900, ']') + "}";
  EXPECT_NE(json_refusal(deep).find("nested"), std::string::npos);
  EXPECT_NE(json_refusal(std::string(1'000'000, '[')).find("longer"), std::string::npos);
}

TEST(JsonCommand, NamesTheNearestKindAndNeverQuotesAStranger) {
  EXPECT_NE(json_refusal(R"({"kind": "pauze"})").find("\"pause\""), std::string::npos);
  EXPECT_EQ(json_refusal(R"({"kind": "<script>"})").find("<script>"), std::string::npos);
}

TEST(JsonCommand, RefusesLanguageTagsThatAreNone) {
  EXPECT_NE(json_refusal(R"({"kind": "language", "text": "../../etc"})"), "");
  EXPECT_NE(json_refusal(R"({"kind": "language", "text": "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa"})"),
            "");
}

TEST(StatusJson, IsValidWhateverTheStatusHolds) {
  PlayerStatus status = test::example_status();
  status.title = "broken \xff UTF-8 \"quoted\" \n </script>";
  status.time_s = std::numeric_limits<double>::quiet_NaN();
  status.frame_ms = std::numeric_limits<double>::infinity();
  const nlohmann::json read = nlohmann::json::parse(status_json(status));
  EXPECT_TRUE(read.at("time_s").is_null());
  EXPECT_TRUE(read.at("frame_ms").is_null());
  EXPECT_EQ(read.at("title"), "broken \uFFFD UTF-8 \"quoted\" \n </script>");
  EXPECT_EQ(read.at("chapters").at(1).at("title"), "The far side");
  for (const char* const key : {"clock", "follows", "sound"}) {
    EXPECT_TRUE(read.contains(key)) << key;
  }
}

nlohmann::json json_of(const PlayerStatus& status) { return nlohmann::json::parse(status_json(status)); }

TEST(StatusJson, TellsTheStateAndTheSilenceOfTheClock) {
  PlayerStatus status = test::example_status();
  EXPECT_EQ(json_of(status).at("clock_state"), "own");
  EXPECT_TRUE(json_of(status).at("clock_silence_s").is_null());
  status.clock_state = "stopped";
  status.clock_silence_s = 3.25;
  EXPECT_EQ(json_of(status).at("clock_state"), "stopped");
  EXPECT_EQ(json_of(status).at("clock_silence_s"), 3.25);
}

TEST(StatusJson, NamesTheCommandsThatWouldBeRefusedAndWhy) {
  PlayerStatus status = test::example_status();
  EXPECT_EQ(json_of(status).at("refused"), nlohmann::json::object());
  status.chapter = 2;
  EXPECT_EQ(json_of(status).at("refused"), (nlohmann::json{{"next_chapter", "this is the last chapter"}}));
  status.chapters.clear();
  status.chapter = -1;
  status.languages.clear();
  EXPECT_EQ(json_of(status).at("refused"), (nlohmann::json{{"chapter", "this show has no chapters"},
                                                           {"next_chapter", "this show has no chapters"},
                                                           {"language", "this show has only one language"}}));
}

TEST(StatusJson, NamesAsRefusedWhatIsRefusedWhileAnotherClockIsFollowed) {
  PlayerStatus status = test::example_status();
  status.follows = "MIDI time code";
  const nlohmann::json refused = json_of(status).at("refused");
  EXPECT_EQ(refused.at("seek"), "the show's time follows MIDI time code");
  for (const CommandRule& rule : command_rules()) {
    const CommandArgument argument = rule.argument == Argument::none           ? CommandArgument()
                                     : rule.argument == Argument::language_tag ? CommandArgument("de")
                                                                               : CommandArgument(1.0);
    bool is_taken = true;
    try {
      checked_command(rule, argument, status);
    } catch (const Error&) {
      is_taken = false;
    }
    EXPECT_EQ(refused.contains(rule.name), !is_taken) << rule.name;
  }
}

TEST(JsonCommand, SuggestsAKindThatIsNearAndNoneThatIsFar) {
  EXPECT_NE(json_refusal(R"({"kind": "vollume"})").find("did you mean \"volume\"?"), std::string::npos);
  EXPECT_NE(json_refusal(R"({"kind": "clock", "value": 3})").find("see reference/http.md"), std::string::npos);
}

TEST(StatusJson, HasEachKeyInItsDocument) {
  std::ifstream file(ERGODOME_TEST_DATA_DIR "/../../content/docs/reference/http.md");
  const std::string document{std::istreambuf_iterator<char>(file), {}};
  const nlohmann::json status = json_of(test::example_status());
  for (const auto& [key, value] : status.items()) {
    EXPECT_NE(document.find("`" + key + "`"), std::string::npos) << key;
  }
}

TEST(JsonCommand, HasEachKindInItsDocument) {
  std::ifstream file(ERGODOME_TEST_DATA_DIR "/../../content/docs/reference/http.md");
  const std::string whole{std::istreambuf_iterator<char>(file), {}};
  const std::size_t begin = whole.find("\n## Commands\n");
  ASSERT_NE(begin, std::string::npos);
  const std::string document = whole.substr(begin, whole.find("\n## ", begin + 1) - begin);
  for (const CommandRule& rule : command_rules()) {
    EXPECT_NE(document.find("`" + std::string(rule.name) + "`"), std::string::npos) << rule.name;
  }
}

}  // namespace
}  // namespace ergodome
