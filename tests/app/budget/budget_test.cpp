#include "app/budget/budget.h"

#include <gmock/gmock.h>

#include "kernels/core/error.h"

namespace ergodome {
namespace {

using testing::HasSubstr;

std::string problem_of(const std::vector<std::string>& words) {
  try {
    parse_budget(words);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Budget, IsAnErrorARateOrBoth) {
  EXPECT_EQ(parse_budget({"0.25px"}), (Budget{0.25, std::nullopt}));
  EXPECT_EQ(parse_budget({"60fps"}), (Budget{std::nullopt, 60.0}));
  EXPECT_EQ(parse_budget({"0.25px,60fps"}), (Budget{0.25, 60.0}));
}

TEST(Budget, IsReadFromOneWordOrSeveralInAnyOrder) {
  const Budget both{0.25, 60.0};
  EXPECT_EQ(parse_budget({"0.25px 60fps"}), both);
  EXPECT_EQ(parse_budget({"60fps", "0.25px"}), both);
  EXPECT_EQ(parse_budget({"60fps, 0.25px"}), both);
}

TEST(Budget, IsEmptyWithoutWords) { EXPECT_TRUE(parse_budget({}).empty()); }

TEST(Budget, IsWrittenAsItIsRead) {
  for (const char* text : {"0.25px", "59.94fps", "0.01px,1000fps"}) {
    EXPECT_EQ(text_of(parse_budget({text})), text);
  }
}

TEST(Budget, HasATimeOfAFrame) { EXPECT_DOUBLE_EQ(parse_budget({"50fps"}).frame_ms(), 20.0); }

TEST(Budget, HasBoundsThatItNames) {
  EXPECT_EQ(parse_budget({"0.01px,1fps"}), (Budget{0.01, 1.0}));
  EXPECT_EQ(parse_budget({"16px,1000fps"}), (Budget{16.0, 1000.0}));
  EXPECT_EQ(problem_of({"0.009px"}), "--budget 0.009px: is out of range; choose from 0.01px to 16px");
  EXPECT_EQ(problem_of({"1001fps"}), "--budget 1001fps: is out of range; choose from 1fps to 1000fps");
  EXPECT_THAT(problem_of({"16.1px"}), HasSubstr("out of range"));
  EXPECT_THAT(problem_of({"0.5fps"}), HasSubstr("out of range"));
  EXPECT_THAT(problem_of({"nanpx"}), HasSubstr("out of range"));
  EXPECT_THAT(problem_of({"-1px"}), HasSubstr("out of range"));
}

TEST(Budget, RefusesWhatHasNoUnitOrAnother) {
  for (const char* word :
       {"0.25", "60", "px", "fast", "60 fps", "0.25pxx", "1e999px", "0.25px60fps", "60Hz", "0x1px"}) {
    EXPECT_THAT(problem_of({word}), HasSubstr("write, for example, --budget 0.25px, --budget 60fps")) << word;
  }
}

TEST(Budget, RefusesNothingAtAll) { EXPECT_THAT(problem_of({" , "}), HasSubstr("is empty")); }

TEST(Budget, RefusesTheSameTwice) {
  EXPECT_EQ(problem_of({"0.25px", "1px"}), "--budget 1px: is a second budget in px; remove one of them");
}

}  // namespace
}  // namespace ergodome
