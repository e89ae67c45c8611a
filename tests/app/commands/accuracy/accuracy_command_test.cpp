#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/app/cli/command_line.h"
#include "tests/support/sanitized.h"

namespace ergodome {
namespace {

using test::CommandLine;
using testing::HasSubstr;
using testing::Not;

constexpr const char* accuracy_show =
    "title = \"A & B <hole>\"\n[hole]\nspin = 0.9\n[camera]\n[[camera.key]]\nr = 8\n[sky]\nmap = \"sky.ppm\"\n"
    "[view]\nsize_px = 48\n";

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

//! Returns the values of an attribute in an HTML page.
std::vector<std::string> values_of(const std::string& page, const std::string& attribute) {
  const std::string opening = fmt::format("{}=\"", attribute);
  std::vector<std::string> values;
  for (std::size_t at = page.find(opening); at != std::string::npos; at = page.find(opening, at)) {
    at += opening.size();
    values.push_back(page.substr(at, page.find('"', at) - at));
  }
  return values;
}

TEST_F(CommandLine, AccuracyWritesAPageThatHasEveryFigureItNames) {
  write("small.toml", accuracy_show);
  ASSERT_EQ(run("accuracy small.toml --quick --rounds 1 --axes map,frame --out report"), 0) << output_;
  const std::string page = text_of(folder_ / "report" / "report.html");
  EXPECT_THAT(page, HasSubstr("A &amp; B &lt;hole&gt;"));
  EXPECT_THAT(page, Not(HasSubstr("<hole>")));
  std::vector<std::string> figures = values_of(page, "src");
  std::ranges::copy(values_of(page, "href"), std::back_inserter(figures));
  EXPECT_GT(figures.size(), 4U);
  for (const std::string& figure : figures) {
    EXPECT_GT(std::filesystem::file_size(folder_ / "report" / figure), 100U) << figure;
  }
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "report")) {
    EXPECT_FALSE(entry.path().filename().string().starts_with(".")) << entry.path();
  }
}

TEST_F(CommandLine, AccuracySaysLastWhereItsPageIs) {
  write("small.toml", accuracy_show);
  ASSERT_EQ(run("accuracy small.toml --quick --rounds 1 --axes map --out report"), 0) << output_;
  EXPECT_THAT(output_, testing::EndsWith("\nReport: report/report.html\n"));
  ASSERT_EQ(run("accuracy small.toml --quick --rounds 1 --axes map"), 0) << output_;
  EXPECT_THAT(output_, Not(HasSubstr("Report:")));
}

TEST_F(CommandLine, AccuracyTellsTheSameInItsTablesAndFiles) {
  write("small.toml", accuracy_show);
  ASSERT_EQ(run("accuracy small.toml --quick --rounds 2 --axes map --out report --json"), 0) << output_;
  const nlohmann::json printed = nlohmann::json::parse(output_.substr(output_.find('{')));
  const nlohmann::json kept = nlohmann::json::parse(text_of(folder_ / "report" / "accuracy.json"));
  EXPECT_EQ(printed, kept);
  ASSERT_EQ(kept["axes"].size(), 1U);
  const nlohmann::json& choices = kept["axes"][0]["choices"];
  ASSERT_EQ(choices.size(), 3U);
  EXPECT_EQ(choices[0]["frame_ms"].size(), 2U);
  std::istringstream lines(text_of(folder_ / "report" / "accuracy.csv"));
  std::string line;
  std::vector<std::string> rows;
  while (std::getline(lines, line)) {
    rows.push_back(line);
  }
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_THAT(rows[1], testing::StartsWith("small,map,point,"));
  EXPECT_THAT(rows[3], testing::StartsWith("small,map,polygon,"));
}

TEST_F(CommandLine, AccuracyOfRaysComparesThePublishedMethods) {
  if (test::sanitized) {
    GTEST_SKIP() << "many rays";
  }
  write("small.toml", accuracy_show);
  ASSERT_EQ(run("accuracy small.toml --quick --size 24 --rounds 1 --axes rays --at 0.25px"), 0) << output_;
  for (const char* const words :
       {"taylor", "baseline_rk34", "quadtree, spline", "an error of at most 0.25 px (p99)", "the method of RK34"}) {
    EXPECT_THAT(output_, HasSubstr(words));
  }
  EXPECT_THAT(output_, Not(HasSubstr("lensed images of stars")));
}

TEST_F(CommandLine, AccuracyRefusesWhatCannotBeMeasured) {
  write("small.toml", accuracy_show);
  const auto refuses = [&](const std::string& words, const std::string& because) {
    EXPECT_NE(run("accuracy " + words), 0) << words;
    EXPECT_THAT(output_, HasSubstr("ergodome: ")) << words;
    EXPECT_THAT(output_, HasSubstr(because)) << words;
  };
  refuses("nothing.toml", "neither a file nor a built-in show");
  refuses("small.toml --size 0", "--size");
  refuses("small.toml --size nan", "--size");
  refuses("small.toml --at nan", "not a number of pixels");
  refuses("small.toml --at 0px", "not a number of pixels");
  refuses("small.toml --moments 0", "--moments");
  refuses("small.toml --axes light", "--axes");
  refuses("small.toml --axes stars", "has nothing to measure for these --axes");
  refuses("small.toml --quick --axes map --out small.toml/report", "small.toml/report");
}

}  // namespace
}  // namespace ergodome
