#include "app/commands/accuracy/report_files.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/commands/accuracy/error_pictures.h"
#include "app/commands/accuracy/report_page.h"
#include "app/commands/accuracy/report_plots.h"
#include "content/files/atomic_file.h"

namespace ergodome {

namespace {

using Json = nlohmann::ordered_json;

//! Returns a field of a CSV line, quoted if it contains a comma, a quote or a line break.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) {
    return text;
  }
  std::string quoted = "\"";
  for (const char letter : text) {
    quoted += letter == '"' ? "\"\"" : std::string(1, letter);
  }
  return quoted + '"';
}

std::string number(double value) { return fmt::format("{:.6g}", value); }

Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json json_of(const ErrorSummary& error) {
  return {{"count", error.count},
          {"median", finite(error.median)},
          {"p99", finite(error.p99)},
          {"p99.9", finite(error.p999)},
          {"max", finite(error.largest)}};
}

Json json_of(const Measurement& choice) {
  Json json = {{"method", choice.method},       {"setting", choice.setting},      {"precision", choice.precision},
               {"published", choice.published}, {"error", json_of(choice.error)}, {"lost", choice.lost}};
  if (choice.flicker) {
    json["flicker_p99"] = finite(*choice.flicker);
  }
  if (choice.light_error) {
    json["light_error"] = json_of(*choice.light_error);
  }
  json["prepare_ms"] = choice.prepare_ms;
  json["frame_ms"] = choice.frame_ms;
  if (!choice.passes_ms.empty()) {
    json["passes_ms"] = choice.passes_ms;
  }
  json["memory_bytes"] = choice.memory_bytes;
  if (choice.disk_bytes) {
    json["disk_bytes"] = *choice.disk_bytes;
  }
  json["pareto"] = choice.best_ready;
  json["pareto_anew"] = choice.best_anew;
  if (!choice.picture.empty()) {
    json["picture"] = choice.picture;
  }
  return json;
}

std::string csv_line(const AccuracyReport& report, const AccuracyAxis& axis, const Measurement& choice) {
  const Spread frame = spread_of(choice.frame_ms);
  const Spread prepare = spread_of(choice.prepare_ms);
  const std::string unit = unit_name(axis.unit);
  std::string line;
  for (const std::string* const word :
       {&report.show, &axis.name, &choice.method, &choice.setting, &choice.precision, &choice.published, &unit}) {
    line += field(*word);
    line += ',';
  }
  for (const double value : {choice.error.median, choice.error.p99, choice.error.p999, choice.error.largest}) {
    line += number(value) + ',';
  }
  line += (axis.unit == ErrorUnit::pixels ? number(choice.error.p99 * report.pixel_arcmin) : "") + ',';
  line += (choice.flicker ? number(*choice.flicker) : "") + ',';
  line += (choice.light_error ? number(choice.light_error->p99) : "") + ',';
  for (const double value :
       {choice.lost, frame.median, frame.minimum, frame.maximum, prepare.median, prepare.minimum, prepare.maximum}) {
    line += number(value) + ',';
  }
  line += fmt::format("{},{},{},{}\n", choice.memory_bytes,
                      choice.disk_bytes ? std::to_string(*choice.disk_bytes) : std::string(), choice.best_ready ? 1 : 0,
                      choice.best_anew ? 1 : 0);
  return line;
}

constexpr const char* ready_caption =
    "Each point is one choice: a method with a setting. A line joins the settings of one method, in the color and with "
    "the number of the legend. Choices farther left are faster; choices farther down are more accurate. Ringed: no "
    "other choice is both faster and more accurate. Dashed: published methods. Thin horizontal bars: from the fastest "
    "to the slowest run.";
constexpr const char* anew_caption =
    "The same with preparation: every frame builds everything that a new camera position needs, such as grids, as in "
    "free flight.";

bool has_preparation(const AccuracyAxis& axis) {
  for (const Measurement& choice : axis.choices) {
    if (spread_of(choice.prepare_ms).median > 0.1 * spread_of(choice.frame_ms).median) {
      return true;
    }
  }
  return false;
}

}  // namespace

std::string csv_text(const AccuracyReport& report) {
  std::string text =
      "show,axis,method,setting,precision,published,unit,error_median,error_p99,error_p99.9,error_max,error_p99_arcmin,"
      "flicker_p99,light_error_p99,lost,frame_ms,frame_ms_least,frame_ms_greatest,prepare_ms,prepare_ms_least,"
      "prepare_ms_greatest,memory_bytes,disk_bytes,pareto,pareto_anew\n";
  for (const AccuracyAxis& axis : report.axes) {
    for (const Measurement& choice : axis.choices) {
      text += csv_line(report, axis, choice);
    }
  }
  return text;
}

std::string json_text(const AccuracyReport& report) {
  Json json = {{"show", report.show},
               {"title", report.title},
               {"machine", report.machine},
               {"date", report.date},
               {"width_px", report.width_px},
               {"height_px", report.height_px},
               {"pixel_arcmin", report.pixel_arcmin},
               {"times_s", report.times_s},
               {"samples", report.samples},
               {"rounds", report.rounds},
               {"took_s", report.took_s},
               {"time_spread", time_spread(report)},
               {"too_busy_to_rank", is_too_busy(report)},
               {"notes", report.notes},
               {"axes", Json::array()}};
  for (const AccuracyAxis& axis : report.axes) {
    Json choices = Json::array();
    for (const Measurement& choice : axis.choices) {
      choices.push_back(json_of(choice));
    }
    json["axes"].push_back({{"name", axis.name},
                            {"title", axis.title},
                            {"unit", unit_name(axis.unit)},
                            {"time", axis.time},
                            {"reference", axis.reference},
                            {"base", axis.base},
                            {"choices", std::move(choices)}});
  }
  return json.dump(1) + '\n';
}

void write_report_folder(AccuracyReport& report, double max_px, const std::filesystem::path& folder) {
  std::vector<ReportPlot> plots;
  bool has_gnuplot = true;
  for (const AccuracyAxis& axis : report.axes) {
    for (const FrameCost cost : {FrameCost::ready, FrameCost::anew}) {
      const bool ready = cost == FrameCost::ready;
      if (!has_gnuplot || !is_plottable(axis) || (!ready && !has_preparation(axis))) {
        continue;
      }
      const std::string file = axis.name + (ready ? ".svg" : "-anew.svg");
      has_gnuplot = draw_plot(axis, cost, folder / file);
      if (has_gnuplot) {
        plots.push_back({axis.name, file, ready ? ready_caption : anew_caption});
      }
    }
  }
  if (!has_gnuplot) {
    report.notes.emplace_back("gnuplot is not installed, so the page has no plots; install the package gnuplot-nox");
  }
  draw_error_pictures(report, max_px, folder);
  write_text_atomically(folder / "accuracy.csv", csv_text(report));
  write_text_atomically(folder / "accuracy.json", json_text(report));
  write_text_atomically(folder / "report.html", page_text(report, plots, max_px));
}

}  // namespace ergodome
