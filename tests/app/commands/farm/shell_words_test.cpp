#include "app/commands/farm/shell_words.h"

#include <gtest/gtest.h>

#include "app/commands/farm/programs.h"

namespace ergodome {
namespace {

TEST(ShellWords, StayLiteralIfTheShellTakesThemSo) {
  EXPECT_EQ(shell_words({"render", "--out=/data/film_1", "--frames=1:12", "a%b"}),
            "render --out=/data/film_1 --frames=1:12 a%b");
}

TEST(ShellWords, ReachProgramsUnchanged) {
  for (const std::string& word :
       {std::string(), std::string("a b"), std::string("it's"),
        std::string("$HOME `id` \"x\" \\ * ? ~ ; & | < > ( ) { } # !"), std::string("two\nlines"),
        std::string("--set=sky.map=\"sky map.png\""), std::string("Schwarzes Loch ä")}) {
    EXPECT_EQ(run_and_read({"bash", "-c", "printf '%s|' " + shell_words({word, word})}, "").output,
              std::string(word).append("|").append(word).append("|"));
  }
}

TEST(ShellWords, RunProgramsAndReportTheirStatus) {
  EXPECT_EQ(run_and_read({"bash", "-c", "echo out; echo problem >&2; exit 3"}, "").status, 3);
  EXPECT_EQ(run_and_read({"bash", "-c", "kill -TERM $$"}, "").status, 128 + 15);
}

}  // namespace
}  // namespace ergodome
