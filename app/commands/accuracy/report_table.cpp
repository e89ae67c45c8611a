#include "app/commands/accuracy/report_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/commands/accuracy/report_words.h"
#include "content/files/printable.h"
#include "render/accuracy/measurement.h"

namespace ergodome {

namespace {

//! Aligns rows of words in columns. The first `left` columns are left-aligned, the others
//! right-aligned.
std::string columns_of(const std::vector<std::vector<std::string>>& rows, std::size_t left) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) {
      widths[i] = std::max(widths[i], row[i].size());
    }
  }
  std::string text;
  for (const auto& row : rows) {
    std::string line = " ";
    for (std::size_t i = 0; i < row.size(); ++i) {
      line += i < left ? fmt::format(" {:<{}}", row[i], widths[i]) : fmt::format("  {:>{}}", row[i], widths[i]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line;
    text += '\n';
  }
  return text;
}

std::vector<std::string> row_of(const AccuracyReport& report, const AccuracyAxis& axis, const Measurement& choice) {
  const Spread frame = spread_of(choice.frame_ms);
  const Spread anew = spread_of(choice.anew_ms());
  std::string marks = choice.best_ready ? "*" : " ";
  marks += choice.best_anew ? "+" : " ";
  std::vector<std::string> row = {marks,
                                  choice.method,
                                  choice.setting,
                                  choice.precision,
                                  choice.published,
                                  error_number(axis, choice.error.median),
                                  error_number(axis, choice.error.p99),
                                  error_number(axis, choice.error.p999),
                                  error_number(axis, choice.error.largest)};
  if (axis.unit == ErrorUnit::pixels) {
    row.push_back(arcmin_text(report, choice.error.p99));
  }
  row.push_back(choice.flicker ? error_number(axis, *choice.flicker) : "");
  row.push_back(choice.lost > 0.0 ? fmt::format("{} %", short_number(100.0 * choice.lost)) : "");
  row.push_back(short_number(frame.median));
  row.push_back(fmt::format("{}-{}", short_number(frame.minimum), short_number(frame.maximum)));
  row.push_back(short_number(anew.median));
  row.push_back(choice.memory_bytes > 0 ? bytes_text(choice.memory_bytes) : "");
  row.push_back(choice.disk_bytes ? bytes_text(*choice.disk_bytes) : "");
  return row;
}

std::string axis_table(const AccuracyReport& report, const AccuracyAxis& axis) {
  std::vector<std::string> head = {"", "method", "setting", "", "published by", "median", "p99", "p99.9", "max"};
  if (axis.unit == ErrorUnit::pixels) {
    head.emplace_back("p99 '");
  }
  for (const char* const word : {"flicker", "lost", "ms", "range", "ms with prep.", "memory", "disk"}) {
    head.emplace_back(word);
  }
  std::vector<std::vector<std::string>> rows = {head};
  for (const Measurement& choice : axis.choices) {
    rows.push_back(row_of(report, axis, choice));
  }
  return fmt::format("\n{} (errors in {}, ms {})\n{}", axis.title, unit_name(axis.unit), axis.time,
                     columns_of(rows, 5));
}

std::string equal_error_table(const AccuracyAxis& axis, double max_px) {
  std::vector<std::vector<std::string>> rows = {
      {"method", "fastest", "ms", "ratio (range)", "fastest with preparation", "ms", "ratio (range)"}};
  const std::vector<EqualErrorRow> ready = compare_at(axis, max_px, FrameCost::ready);
  const std::vector<EqualErrorRow> anew = compare_at(axis, max_px, FrameCost::anew);
  for (std::size_t i = 0; i < ready.size(); ++i) {
    std::vector<std::string> row = {ready[i].method};
    for (const auto& [entry, cost] : {std::pair(&ready[i], FrameCost::ready), std::pair(&anew[i], FrameCost::anew)}) {
      const Measurement* const choice = entry->choice;
      const bool known = choice != nullptr;
      row.push_back(known ? choice->setting + (choice->precision.empty() ? "" : ", ") + choice->precision : "none");
      row.push_back(known ? short_number(cost_ms(*choice, cost)) : "");
      row.push_back(entry->ratio.runs > 0 ? spread_text(entry->ratio) : "");
    }
    rows.push_back(std::move(row));
  }
  return fmt::format(
      "\n{}: fastest setting with an error of at most {} (p99){}\n{}", axis.title, error_text(axis, max_px),
      axis.base.empty() ? std::string() : ", ratio = time relative to that of " + axis.base, columns_of(rows, 2));
}

}  // namespace

std::string arcmin_text(const AccuracyReport& report, double error_px) {
  return short_number(error_px * report.pixel_arcmin);
}

std::string table_text(const AccuracyReport& report, double max_px) {
  std::string text = fmt::format("{}: {} x {} pixels of {} arcmin; {}; {} UTC\n", report.title, report.width_px,
                                 report.height_px, short_number(report.pixel_arcmin), report.machine, report.date);
  text += fmt::format("{} of the show, {} compared at each, {} of each choice, took {:.0f} s\n",
                      counted(report.times_s.size(), "moment"), counted(report.samples, "pixel"),
                      counted(report.rounds, "run"), report.took_s);
  text +=
      "p99: 99 % of the samples have a smaller error; p99 ': the same in arcminutes\n"
      "*: no other choice is both faster and more accurate\n"
      "+: the same with preparation (building what a new camera position needs, such as grids)\n";
  text += repeatability_words(report) + '\n';
  for (const AccuracyAxis& axis : report.axes) {
    text += axis_table(report, axis);
  }
  for (const AccuracyAxis& axis : report.axes) {
    if (axis.unit == ErrorUnit::pixels && !axis.base.empty()) {
      text += equal_error_table(axis, max_px);
    }
  }
  text += '\n';
  for (const std::string& sentence : accuracy_sentences(report)) {
    text += sentence;
    text += '\n';
  }
  for (const std::string& note : report.notes) {
    text += "Note: ";
    text += note;
    text += '\n';
  }
  return text;
}

}  // namespace ergodome
