#include "content/files/toml_bounds.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "content/files/toml_table.h"
#include "tests/support/errors.h"

namespace ergodome {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string problem_of(const std::string& text) {
  return test::error_of([&] { require_bounded_toml(text, "a.toml"); });
}

std::string times(int count, const std::function<std::string(int)>& part) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    text += part(i);
  }
  return text;
}

std::string dotted(int parts) {
  return "a" + times(parts - 1, [](int /*i*/) { return std::string(".a"); });
}

TEST(TomlBounds, KeysMayHaveSixteenParts) {
  EXPECT_EQ(problem_of(dotted(16) + " = 1\n[" + dotted(16) + "]\n\"a\" . \"b.c.d.e.f.g.h.i.j.k.l.m.n.o.p.q.r\" = 1\n"),
            "");
  EXPECT_THAT(problem_of("b = 1\n" + dotted(17) + " = 1\n"), StartsWith("a.toml:2: has a key of more than 16 parts"));
  EXPECT_THAT(problem_of("\n\n[[" + dotted(17) + "]]\n"), StartsWith("a.toml:3: has a key of more than 16 parts"));
  EXPECT_THAT(problem_of("b = { " + dotted(17) + " = 1 }\n"), HasSubstr("16 parts"));
  EXPECT_THAT(problem_of(times(17, [](int i) { return std::string(i > 0 ? ".'a'" : "'a'"); }) + " = 1"),
              HasSubstr("16 parts"));
}

TEST(TomlBounds, BracketsMayNestThirtyTwoDeep) {
  const auto nested = [](int depth) {
    return "a = " + std::string(static_cast<std::size_t>(depth), '[') +
           std::string(static_cast<std::size_t>(depth), ']');
  };
  EXPECT_EQ(problem_of(nested(32)), "");
  EXPECT_THAT(problem_of(nested(33)), HasSubstr("deeper than 32 levels"));
}

TEST(TomlBounds, StringsAndCommentsCountForNothing) {
  const std::string trap = std::string(100, '[') + dotted(100);
  for (std::string text : {R"(a = "@\"@")", R"(a = '@\')", "# @\"\"\"\na = 1", "a = \"\"\"\n@\n\\\"\"\"@\n\"\"\"\"\"",
                           "a = '''\n@'''''\nb = 1", "a = \"\"\"\\\n  @\"\"\"", "a = \"\" # @"}) {
    for (std::size_t at = text.find('@'); at != std::string::npos; at = text.find('@')) {
      text.replace(at, 1, trap);
    }
    EXPECT_EQ(problem_of(text), "") << text;
  }
}

TEST(TomlBounds, NothingHidesBehindAnEndedString) {
  const std::string deep = dotted(17) + " = 1";
  for (const char* const before :
       {"a = \"\"\n", "a = ''\n", "a = \"\"\"\"\"\"\n", "a = \"\"\"\"\"\"\"\n", "a = \"\"\"x\"\"\"\"\"\n",
        "a = ''''''\n", "a = \"\\\\\"\n", "a = '\\'\n", "# \"\n", "# '''\n", "a = \"open\n", "\"\" = 1\n"}) {
    EXPECT_THAT(problem_of(std::string(before).append(deep)), HasSubstr("16 parts")) << before;
  }
}

TEST(TomlBounds, ManyEqualHeadersAreAListAndManyDifferentOnesAreRefused) {
  EXPECT_EQ(problem_of(times(100'000, [](int i) { return "[[camera.key]]\nr = " + std::to_string(i) + "\n"; })), "");
  EXPECT_THAT(problem_of(times(50'000, [](int i) { return "[[k" + std::to_string(i) + "]]\n"; })),
              HasSubstr("more than 40000 parts in dotted keys"));
  EXPECT_THAT(problem_of(times(50'000, [](int i) { return "k" + std::to_string(i) + ".a = 1\n"; })),
              HasSubstr("more than 40000 parts in dotted keys"));
}

TEST(TomlBounds, MostValuesAreAMillion) {
  const auto zeros = [](int count) {
    return "a = [" + times(count - 1, [](int /*i*/) { return std::string("0,"); }) + "0]";
  };
  EXPECT_EQ(problem_of(zeros(999'000)), "");
  EXPECT_THAT(problem_of(zeros(1'000'001)), HasSubstr("more than 1000000 values"));
  // The limit counts each value once. An array of 100,000 tables of five values stays below a
  // million, because commas and keys do not count in addition.
  EXPECT_EQ(problem_of("a = [" +
                       times(100'000,
                             [](int /*i*/) {
                               return std::string("{ t_s = 0, r = 1, theta_deg = 2, phi_deg = 3, yaw_deg = 4 },");
                             }) +
                       "]"),
            "");
}

TEST(TomlText, HoldsNoControlCharacters) {
  const auto title = [](const std::string& text) {
    const toml::table table = parse_toml("title = \"" + text + "\"", "a.toml", 1, "a show");
    return test::error_of([&] { TomlTable(table, "a.toml", "").text("title", ""); });
  };
  EXPECT_EQ(title("Grüße — 黑洞"), "");
  for (const char* const control : {"\\u001b[31m", "\\u0007", "\\u009b31m", "\\u007f", "\\u0000"}) {
    EXPECT_THAT(title(control), StartsWith("a.toml:1: title contains a control character")) << control;
  }
  EXPECT_THAT(title("a\\nb"), HasSubstr("line break"));
}

TEST(TomlText, UnknownKeysAndTheParsersOwnWordsAreFitForATerminal) {
  const toml::table table = parse_toml("\"\\u001b[31m\" = 1", "a.toml", 1, "a show");
  const std::string problem = test::error_of([&] { TomlTable(table, "a.toml", "").refuse_unknown_keys(); });
  EXPECT_EQ(problem.find('\x1b'), std::string::npos);
  EXPECT_THAT(problem, HasSubstr("\\x1B"));
  const std::string longest = std::string(500'000, 'a');
  EXPECT_LT(test::error_of([&] { parse_toml("[" + longest + "]\n[" + longest + "]\n", "a.toml", 1, "a show"); }).size(),
            1000U);
}

}  // namespace
}  // namespace ergodome
