#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <sstream>
#include <vector>

#include "tests/app/cli/command_line.h"

namespace ergodome {
namespace {

using test::CommandLine;

//! Returns the text of the page that lists the commands.
std::string commands_page() {
  std::ifstream stream(ERGODOME_TEST_DATA_DIR "/../../content/docs/reference/commands.md");
  return {std::istreambuf_iterator<char>(stream), {}};
}

//! Returns the part of a page under a heading of the second level, or an empty string if the
//! heading is missing.
std::string part_of_page(const std::string& page, const std::string& heading) {
  const std::string line = fmt::format("\n## {}\n", heading);
  const std::size_t from = page.find(line);
  return from == std::string::npos ? "" : page.substr(from, page.find("\n## ", from + 1) - from);
}

//! Returns the first word of each indented line in a help text that begins with `start` after the
//! indentation. Ignores everything before the text `after`.
std::vector<std::string> words_of_help(const std::string& help, const std::string& after, const std::string& start) {
  std::vector<std::string> words;
  std::istringstream lines(help.substr(std::min(help.find(after), help.size())));
  std::string line;
  while (std::getline(lines, line)) {
    if (line.starts_with("  " + start) && line.size() > 2 && line[2] != ' ') {
      words.push_back(line.substr(2, line.find_first_of(" {,", 2) - 2));
    }
  }
  return words;
}

//! Returns whether a text contains an option as a whole word.
bool names_option(const std::string& text, const std::string& option) {
  for (std::size_t at = text.find(option); at != std::string::npos; at = text.find(option, at + 1)) {
    const std::size_t end = at + option.size();
    const auto next = end < text.size() ? static_cast<unsigned char>(text[end]) : static_cast<unsigned char>(' ');
    if (std::isalpha(next) == 0 && next != '-') {
      return true;
    }
  }
  return false;
}

class CommandsPage : public CommandLine {};

TEST_F(CommandLine, HelpFitsIntoTheColumnsOfATerminal) {
  ASSERT_EQ(run("--help"), 0) << output_;
  EXPECT_THAT(output_, testing::HasSubstr("\nPrepare:\n  bake "));
  for (const std::string& command : words_of_help(output_, "Show:", "")) {
    ASSERT_EQ(run(command + " --help"), 0) << output_;
    std::istringstream lines(output_);
    for (std::string line; std::getline(lines, line);) {
      EXPECT_LE(line.size(), 120U) << command << ": " << line;
    }
  }
}

TEST_F(CommandLine, HelpNamesMeaningChoicesRangeAndDefaultOfAnOption) {
  ASSERT_EQ(run("render --help"), 0) << output_;
  EXPECT_THAT(
      output_,
      testing::AllOf(testing::HasSubstr("\nFiles:\n  --format NAME "),
                     testing::HasSubstr("\n  --size N                    width of one eye's image in pixels "
                                        "(1 to 16384; default: the show's)\n"),
                     testing::HasSubstr("\n  --projection NAME           projection: dome, equirect, cube, cylinder, "
                                        "pinhole (default: the show's)\n")));
  ASSERT_EQ(run("trace --help"), 0) << output_;
  EXPECT_THAT(output_, testing::HasSubstr("\n  --out FILE                  table to write (required)\n"));
}

TEST_F(CommandsPage, NamesEveryOptionOfEveryCommand) {
  const std::string page = commands_page();
  const std::string shared = part_of_page(page, "Shared options");
  ASSERT_EQ(run("--help"), 0) << output_;
  const std::vector<std::string> commands = words_of_help(output_, "Show:", "");
  ASSERT_GE(commands.size(), 13U) << output_;
  for (const std::string& command : commands) {
    const std::string part = part_of_page(page, command);
    EXPECT_FALSE(part.empty()) << command;
    ASSERT_EQ(run(command + " --help"), 0) << output_;
    for (const std::string& option : words_of_help(output_, "Options:", "--")) {
      const bool described = names_option(part, option) ||
                             (part.find("(#shared-options)") != std::string::npos && names_option(shared, option));
      EXPECT_TRUE(described) << command << " " << option;
    }
  }
}

}  // namespace
}  // namespace ergodome
