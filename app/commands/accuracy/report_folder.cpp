#include "app/commands/accuracy/report_folder.h"

#include "app/commands/accuracy/error_pictures.h"
#include "app/commands/accuracy/report_files.h"
#include "app/commands/accuracy/report_page.h"
#include "app/commands/accuracy/report_plots.h"
#include "content/files/atomic_file.h"

namespace ergodome {

namespace {

constexpr const char* ready_caption =
    "Each point is a choice; a line joins those of one method, which has its number and colour from the legend. "
    "Choices "
    "further to the left are faster, those further down more exact. Rings: no other choice is both faster and more "
    "exact. Dashed: published methods. Thin lines to the sides: from the fastest to the slowest run.";
constexpr const char* anew_caption =
    "The same where all that a new place of the camera takes is made anew in each frame, as in free flight: grids are "
    "built, not only read.";

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
    report.notes.emplace_back("there is no gnuplot here, so the page has no plots; install the package gnuplot-nox");
  }
  draw_error_pictures(report, most_px, folder);
  write_text_atomically(folder / "accuracy.csv", csv_text(report));
  write_text_atomically(folder / "accuracy.json", json_text(report));
  write_text_atomically(folder / "report.html", page_text(report, plots, most_px));
}

}  // namespace ergodome
