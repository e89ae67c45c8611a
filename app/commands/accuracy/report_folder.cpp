#include "app/commands/accuracy/report_folder.h"

#include "app/commands/accuracy/error_pictures.h"
#include "app/commands/accuracy/report_files.h"
#include "app/commands/accuracy/report_page.h"
#include "app/commands/accuracy/report_plots.h"
#include "content/files/atomic_file.h"

namespace ergodome {

namespace {

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

void write_report_folder(AccuracyReport& report, double most_px, const std::filesystem::path& folder) {
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
  draw_error_pictures(report, most_px, folder);
  write_text_atomically(folder / "accuracy.csv", csv_text(report));
  write_text_atomically(folder / "accuracy.json", json_text(report));
  write_text_atomically(folder / "report.html", page_text(report, plots, most_px));
}

}  // namespace ergodome
