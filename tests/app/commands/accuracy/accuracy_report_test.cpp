#include <gmock/gmock.h>

#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/commands/accuracy/error_pictures.h"
#include "app/commands/accuracy/report_files.h"
#include "app/commands/accuracy/report_page.h"
#include "app/commands/accuracy/report_plots.h"
#include "app/commands/accuracy/report_table.h"
#include "app/commands/accuracy/report_words.h"
#include "tests/support/errors.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr double infinity = std::numeric_limits<double>::infinity();

Measurement choice(const std::string& method, const std::string& setting, double p99, double ms) {
  Measurement measured;
  measured.method = method;
  measured.setting = setting;
  measured.error = {1000, 0.1 * p99, p99, 4.0 * p99, 9.0 * p99};
  measured.frame_ms = {ms, 1.5 * ms, 0.5 * ms};
  measured.prepare_ms = {1.0, 1.0, 1.0};
  measured.map = {2, 2, {0.0F, 0.01F, 1000.0F, std::numeric_limits<float>::quiet_NaN()}};
  return measured;
}

AccuracyReport small_report() {
  AccuracyReport report;
  report.show = "round, and \"about\"";
  report.title = "Round <about> & back";
  report.machine = "processor";
  report.date = "2026-11-23 04:00";
  report.width_px = report.height_px = 64;
  report.pixel_arcmin = 10.0;
  report.times_s = {0.0};
  report.samples = 100;
  report.rounds = 3;
  AccuracyAxis axis;
  axis.name = "rays";
  axis.title = "Where light comes from";
  axis.reference = "the truth";
  axis.base = "taylor";
  axis.choices = {choice("taylor", "fine", 0.2, 3.0),         choice("taylor", "finest", 0.09, 7.0),
                  choice("rk34", "coarse", 3.0, 2.0),         choice("rk34", "fine", 0.08, 14.0),
                  choice("lost", "all of it", infinity, 1.0), choice("slow", "fine", 0.3, 30.0)};
  axis.choices[3].published = "RK34";
  axis.choices[1].flicker = 0.05;
  axis.choices[1].disk_bytes = 20'000;
  mark_pareto(axis);
  report.axes.push_back(axis);
  return report;
}

TEST(AccuracyReport, SaysWhatAQuarterPixelAndATenthCost) {
  EXPECT_THAT(
      axis_sentences(small_report().axes[0]),
      ElementsAre(
          "Errors up to a quarter pixel cost 3.0 ms per frame (taylor, fine); errors up to a tenth of a pixel cost 7.0 "
          "ms (taylor, finest).",
          "rk34 (the method of RK34) takes 2.0 times as long as taylor for errors of at most a tenth of a pixel."));
}

TEST(AccuracyReport, TellsAxesOfFewChoicesOneByOne) {
  AccuracyAxis axis;
  axis.unit = ErrorUnit::light;
  axis.choices = {choice("ewa", "an ellipse", 0.5, 4.0)};
  axis.choices[0].lost = 0.25;
  EXPECT_THAT(
      axis_sentences(axis),
      ElementsAre("ewa (an ellipse): the error is at most 5.0 % in half of the samples and at most 50 % in 99 %; "
                  "4.0 ms per frame; 25 % of the samples are missing."));
}

TEST(AccuracyReport, MarksTheParetoFrontInItsTable) {
  std::istringstream lines(table_text(small_report(), 0.1));
  std::string line;
  std::vector<std::string> marked;
  while (std::getline(lines, line)) {
    if (line.starts_with("  *")) {
      marked.push_back(line.substr(5, 13));
    }
  }
  EXPECT_THAT(marked, ElementsAre("taylor fine  ", "taylor finest", "rk34   coarse", "rk34   fine  "));
}

TEST(AccuracyReport, ShowsErrorsInArcminutesToo) {
  EXPECT_EQ(arcmin_text(small_report(), 0.2), "2.0");
  EXPECT_THAT(table_text(small_report(), 0.1), HasSubstr("p99 '"));
}

TEST(AccuracyReport, ItsCsvReadsBack) {
  const AccuracyReport report = small_report();
  std::istringstream lines(csv_text(report));
  std::string head;
  std::string first;
  std::getline(lines, head);
  std::getline(lines, first);
  const auto commas = [](const std::string& line) { return std::ranges::count(line, ','); };
  // The row has one more comma than the header, because the quoted title contains a comma.
  EXPECT_EQ(commas(first), commas(head) + 1);
  EXPECT_THAT(first,
              testing::StartsWith(
                  "\"round, and \"\"about\"\"\",rays,taylor,fine,,,px,0.02,0.2,0.8,1.8,2,,,0,3,1.5,4.5,1,1,1,0,,1,1"));
  EXPECT_THAT(csv_text(report), HasSubstr("lost,all of it,,,px,inf,inf"));
}

TEST(AccuracyReport, ItsJsonReadsBack) {
  const nlohmann::json json = nlohmann::json::parse(json_text(small_report()));
  EXPECT_EQ(json["show"], "round, and \"about\"");
  const nlohmann::json& choices = json["axes"][0]["choices"];
  ASSERT_EQ(choices.size(), 6U);
  EXPECT_EQ(choices[1]["error"]["p99"], 0.09);
  EXPECT_EQ(choices[1]["flicker_p99"], 0.05);
  EXPECT_EQ(choices[1]["disk_bytes"], 20'000);
  EXPECT_EQ(choices[0]["frame_ms"], (std::vector<double>{3.0, 4.5, 1.5}));
  EXPECT_TRUE(choices[4]["error"]["p99"].is_null());
  EXPECT_FALSE(choices[0].contains("disk_bytes"));
}

TEST(AccuracyReport, ItsPageEscapesWhatAShowIsCalled) {
  const std::string page = page_text(small_report(), {{"rays", "rays.svg", "the plot"}}, 0.1);
  EXPECT_THAT(page, HasSubstr("Round &lt;about&gt; &amp; back"));
  EXPECT_THAT(page, HasSubstr("round, and &quot;about&quot;"));
  EXPECT_THAT(page, Not(HasSubstr("<about>")));
  EXPECT_THAT(page, HasSubstr("src=\"rays.svg\""));
}

TEST(AccuracyReport, ItsPlotLeavesOutErrorsWithoutBounds) {
  const std::string script = plot_script(small_report().axes[0], FrameCost::ready, "out \"of\" here.svg");
  EXPECT_THAT(script, HasSubstr("3 0.2 1.5 4.5\n"));
  EXPECT_THAT(script, Not(HasSubstr("inf")));
  EXPECT_THAT(script, Not(HasSubstr("\"lost\"")));
  EXPECT_THAT(script, HasSubstr("set output \"out  of  here.svg\"\n"));
}

TEST(AccuracyReport, NumbersItsMethodsInPlotLegendAndTable) {
  AccuracyReport report = small_report();
  report.axes[0].choices[1].precision = "double";
  const std::string page = page_text(report, {}, 0.1);
  // The first axis has the methods taylor, taylor in double, rk34 and rk34 as published, numbered 1
  // to 4; the second axis has the methods `lost` and `slow`.
  EXPECT_THAT(page, HasSubstr("#56b4e9\">1</span> <b>taylor</b>: Ergodome's integrator"));
  EXPECT_THAT(page, HasSubstr("#56b4e9\">2</span> <b>taylor, double</b>: the same in double precision"));
  EXPECT_THAT(page, HasSubstr("#6a3d9a\">4</span> <b>rk34 (RK34)</b>"));
  EXPECT_THAT(page, HasSubstr("<td>4</td><td class=\"word\">rk34</td><td class=\"word\">fine</td>"));
  const std::string script = plot_script(report.axes[0], FrameCost::ready, "rays.svg");
  EXPECT_THAT(script, HasSubstr("$s4 using 1:2:(\"4\") every ::0::0 with labels"));
}

TEST(AccuracyReport, ExplainsEveryMethodThatItMeasures) {
  for (const char* const method : {"direct rays",
                                   "conforming grid",
                                   "quadtree, linear",
                                   "quadtree, spline",
                                   "quadtree",
                                   "taylor",
                                   "cash_karp",
                                   "rk34",
                                   "baseline_rk34",
                                   "closed_form",
                                   "stations with derivatives",
                                   "plain stations",
                                   "point",
                                   "ewa",
                                   "polygon",
                                   "physical",
                                   "flat",
                                   "omni",
                                   "rays",
                                   "polygons",
                                   "inverse",
                                   "gather"}) {
    EXPECT_NE(method_words(method), "") << method;
  }
}

TEST(AccuracyReport, FitsOnAPhone) {
  const std::string page = page_text(small_report(), {}, 0.1);
  EXPECT_THAT(page, HasSubstr("<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"));
  // Each table is in a container that scrolls separately, because it may be wider than the page.
  std::size_t tables = 0;
  for (std::size_t at = page.find("<table>"); at != std::string::npos; at = page.find("<table>", at + 1)) {
    const std::string before = page.substr(at - 19, 19);
    EXPECT_THAT(before, HasSubstr("<div class=\"wide\">")) << ++tables;
  }
}

TEST(AccuracyReport, WarnsWhereTimesRepeatTooBadlyToRankMethods) {
  AccuracyReport report = small_report();
  EXPECT_DOUBLE_EQ(time_spread(report), 3.0);
  const std::string busy = "The machine was too busy to rank methods: the slowest run of a choice took 3.00 times";
  EXPECT_THAT(page_text(report, {}, 0.1), HasSubstr("<p class=\"busy\">" + busy));
  EXPECT_THAT(table_text(report, 0.1), HasSubstr(busy));
  EXPECT_TRUE(nlohmann::json::parse(json_text(report))["too_busy_to_rank"]);
  for (Measurement& each : report.axes[0].choices) {
    each.frame_ms = {1.0, 1.2, 1.1};
  }
  // One of three times is an outlier, and the spread remains that of the other choices.
  report.axes[0].choices[0].frame_ms = {1.0, 9.0, 1.0};
  EXPECT_DOUBLE_EQ(time_spread(report), 1.2);
  EXPECT_THAT(table_text(report, 0.1), HasSubstr("The machine was quiet enough to rank methods"));
  EXPECT_THAT(page_text(report, {}, 0.1), Not(HasSubstr("class=\"busy\"")));
  for (Measurement& each : report.axes[0].choices) {
    each.frame_ms = {1.0};
  }
  EXPECT_THAT(table_text(report, 0.1), HasSubstr("No choice was timed more than once"));
}

TEST(AccuracyReport, APlotNeedsTwoPoints) {
  AccuracyAxis axis = small_report().axes[0];
  EXPECT_TRUE(is_plottable(axis));
  axis.choices = {axis.choices[0], axis.choices[4]};
  EXPECT_FALSE(is_plottable(axis));
}

TEST(AccuracyReport, NumbersHaveAsManyDigitsAsAreRead) {
  EXPECT_EQ(short_number(0.0), "0");
  EXPECT_EQ(short_number(0.00123), "0.0012");
  EXPECT_EQ(short_number(7.04), "7.0");
  EXPECT_EQ(short_number(34.6), "35");
  EXPECT_EQ(short_number(1.2e6), "1.2e+06");
  EXPECT_EQ(short_number(infinity), "-");
  EXPECT_EQ(bytes_text(20'136), "20 kB");
  EXPECT_EQ(bytes_text(2'097'152), "2.1 MB");
}

using AccuracyReportFolder = test::FolderTest;

TEST_F(AccuracyReportFolder, HoldsErrorPicturesInTheirColours) {
  AccuracyReport report = small_report();
  draw_error_pictures(report, 0.1, folder_);
  EXPECT_EQ(report.axes[0].choices[5].picture, "error-rays-6.png");
  const std::string name = report.axes[0].choices[0].picture;
  ASSERT_FALSE(name.empty());
  EXPECT_TRUE(std::filesystem::exists(folder_ / name));
}

TEST_F(AccuracyReportFolder, IsWholeWithoutGnuplotAndSaysSo) {
  AccuracyReport report = small_report();
  const char* const before = std::getenv("PATH");
  const std::string kept = before != nullptr ? before : "";
  ::setenv("PATH", folder_.c_str(), 1);
  write_report_folder(report, 0.1, folder_);
  ::setenv("PATH", kept.c_str(), 1);
  ASSERT_EQ(report.notes.size(), 1U);
  EXPECT_THAT(report.notes[0], HasSubstr("gnuplot-nox"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "report.html"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "accuracy.csv"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "rays.svg"));
}

TEST_F(AccuracyReportFolder, ThatCannotBeWrittenIsAnError) {
  AccuracyReport report = small_report();
  EXPECT_NE(test::error_of([&] { write_report_folder(report, 0.1, folder_ / "not" / "there"); }), "");
}

}  // namespace
}  // namespace ergodome
