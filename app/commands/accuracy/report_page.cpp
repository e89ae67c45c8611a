#include "app/commands/accuracy/report_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/commands/accuracy/error_pictures.h"
#include "app/commands/accuracy/report_plots.h"
#include "app/commands/accuracy/report_table.h"
#include "app/commands/accuracy/report_words.h"
#include "content/files/printable.h"
#include "kernels/image/color_map.h"
#include "render/accuracy/measurement.h"

namespace ergodome {

namespace {

constexpr const char* style = R"(<style>
body { font: 16px/1.5 "DejaVu Sans", sans-serif; color: #222; max-width: 62em; margin: 2em auto; padding: 0 1em; }
.busy { background: #fdf3e1; border-left: 4px solid #d55e00; padding: 0.6em 1em; margin: 1em 0; }
h1 { font-size: 1.7em; margin-bottom: 0.1em; } h2 { margin-top: 2em; border-top: 1px solid #ddd; padding-top: 0.8em; }
.facts, .caption, figcaption { color: #666; font-size: 0.85em; }
.says { background: #f2f6fa; border-left: 4px solid #0072b2; padding: 0.6em 1em; margin: 1em 0; }
.says p { margin: 0.3em 0; }
img.plot { width: 100%; max-width: 640px; height: auto; display: block; }
.pictures { display: flex; flex-wrap: wrap; gap: 14px; }
figure { margin: 0; width: 170px; } figure img { width: 170px; image-rendering: pixelated; display: block; }
.best figcaption b::after { content: " \25EF"; }
table { border-collapse: collapse; font-size: 0.8em; } td, th { padding: 2px 8px; text-align: right; white-space: nowrap; }
th { border-bottom: 1px solid #888; } td.word, th.word { text-align: left; } tr.best { background: #eef7ee; }
.methods { font-size: 0.85em; color: #444; padding: 0; list-style: none; } .methods li { margin: 0.3em 0; padding-left: 2.2em; }
.number { float: left; margin-left: -2.2em; min-width: 1.5em; text-align: center; border-radius: 0.8em; color: #fff; font-weight: bold; }
.wide { overflow-x: auto; } .bar { height: 12px; max-width: 340px; }
summary { cursor: pointer; padding: 0.3em 0; }
@media (max-width: 600px) { body { margin: 1em auto; padding: 0 0.7em; overflow-wrap: break-word; } h1 { font-size: 1.4em; } .says, .busy { padding: 0.4em 0.7em; } }
</style>
)";

constexpr const char* columns_caption =
    "<p class=\"caption\">Errors: “99 %” is the error that 99 % of the samples stay below, and so on. Flicker: how "
    "much the error changes from one frame to the next (99 %). Lost: samples that the method shows as dark, or not at "
    "all. Times are medians; the range is from the fastest to the slowest frame. Preparation: time to build what the "
    "method needs at a new camera position. Green rows: no other choice is "
    "both faster and more accurate.</p>\n";

constexpr const char* published_methods =
    "<p class=\"caption\">Published methods, as implemented in Ergodome: <b>VE</b>, Verbraeck &amp; Eisemann, "
    "Interactive Black-Hole Visualization (2021); <b>MSW</b>, Müller, Schulz &amp; Weiskopf, Adaptive polygon "
    "rendering in the Schwarzschild spacetime (2021); <b>HP</b>, Hamilton &amp; Polhemus, Stereoscopic visualization "
    "in curved spacetime (2010); <b>RK34</b>, a published GLSL ray tracer with an embedded Runge-Kutta 3(4) "
    "pair.</p>\n";

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char letter : text) {
    switch (letter) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += letter;
    }
  }
  return safe;
}

std::string head_text(const AccuracyReport& report) {
  std::string text =
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<meta "
      "name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>What accuracy costs: " +
      escaped(report.title) + "</title>\n" + style + "</head><body>\n";
  text += "<h1>What accuracy costs in time: " + escaped(report.title) + "</h1>\n";
  text += fmt::format(
      "<p class=\"facts\">Show <code>{}</code>, {}; pictures of {} × {} pixels. One pixel spans {} arcminutes (the "
      "full moon: 31). {}; {} UTC. Everything was measured on this machine: {} pixels compared at each moment, and {} "
      "timed runs of each choice.</p>\n",
      escaped(report.show), counted(report.times_s.size(), "moment"), report.width_px, report.height_px,
      short_number(report.pixel_arcmin), escaped(report.machine), escaped(report.date), report.samples, report.rounds);
  text +=
      "<p>A black hole bends light. For each pixel, Ergodome computes which part of the sky the light comes from. "
      "Some methods are fast and rough, others are slow and accurate. A wrong result shows a part of the sky at a "
      "wrong position on the screen. The <b>error</b> on this page is the distance between the wrong and the correct "
      "position, in pixels (px). Where only brightness is compared, it is the difference of the light, in "
      "percent.</p>\n<p>“An error of at most a tenth of a pixel” means that 99 % of the pixels have a smaller error. "
      "Viewers can just see an error of half a pixel, but smaller errors flicker if they change from frame to frame. "
      "A film with 60 frames per second leaves 16.7 milliseconds (ms) for each frame; one with 30 leaves 33.3 "
      "ms.</p>\n";
  return text;
}

std::string colour_bar(bool light) {
  std::string stops;
  for (int i = 0; i <= 8; ++i) {
    const Vector3<float> colour = heat_color(static_cast<float>(i) / 8.0F);
    stops += fmt::format("{}rgb({:.0f},{:.0f},{:.0f})", i == 0 ? "" : ",", 255.0F * colour.x, 255.0F * colour.y,
                         255.0F * colour.z);
  }
  return fmt::format(
      "<div class=\"bar\" style=\"background:linear-gradient(to right,{})\"></div>\n<p class=\"caption\">Brightness "
      "shows the error on a logarithmic scale, from {} (dark) to {} or more (bright). Gray: not compared (the shadow, "
      "its edge, and outside the picture). Below each map: the error of 99 % of the pixels, and the time. \u25ef: no "
      "other choice is both faster and more accurate.</p>\n",
      stops, light ? "0.001 %" : "0.0001 px", light ? "100 %" : "10 px");
}

//! Returns the numbered legend of an axis in HTML: for each series, its number in the color of its
//! line in the plots, its name, and an explanation of its method.
std::string legend_text(const AccuracyAxis& axis) {
  std::string text;
  std::vector<std::string> explained;
  for (const ReportSeries& series : series_of(axis)) {
    const Measurement& first = *series.choices.front();
    const bool again = std::ranges::find(explained, first.method) != explained.end();
    explained.push_back(first.method);
    const std::string words = again ? "the same in " + first.precision + " precision" : method_words(first.method);
    text += fmt::format("<li><span class=\"number\" style=\"background:{}\">{}</span> <b>{}</b>{}{}</li>\n",
                        series.colour, series.number, escaped(series.name), words.empty() ? "" : ": ", escaped(words));
  }
  return "<p class=\"caption\">The methods, with their numbers in plots and tables (float and double: single and "
         "double precision):</p>\n<ol class=\"methods\">\n" +
         text + "</ol>\n";
}

int series_number(const std::vector<ReportSeries>& all, const Measurement& choice) {
  const auto has = [&](const ReportSeries& series) {
    return std::ranges::find(series.choices, &choice) != series.choices.end();
  };
  const auto found = std::ranges::find_if(all, has);
  return found != all.end() ? found->number : 0;
}

std::string pictures_text(const AccuracyAxis& axis) {
  std::string text;
  for (const Measurement& choice : axis.choices) {
    if (choice.picture.empty()) {
      continue;
    }
    text += fmt::format(
        "<figure{}><img src=\"{}\" alt=\"error map\"><figcaption><b>{}</b><br>{}<br>{} in {} "
        "ms</figcaption></figure>\n",
        choice.best_ready ? " class=\"best\"" : "", escaped(choice.picture), escaped(choice.method),
        escaped(choice.setting + (choice.precision.empty() ? "" : ", " + choice.precision)),
        error_text(axis, choice.error.p99), short_number(spread_of(choice.frame_ms).median));
  }
  return text.empty() ? text
                      : "<p>Error maps: where in the picture each choice is wrong.</p>\n<div class=\"pictures\">\n" +
                            text + "</div>\n" + colour_bar(axis.unit == ErrorUnit::light);
}

std::string table_of(const AccuracyReport& report, const AccuracyAxis& axis) {
  const bool light = axis.unit == ErrorUnit::light;
  std::string text = fmt::format(
      "<details><summary>All {} choices</summary><div class=\"wide\"><table><tr><th></th><th "
      "class=\"word\">method</th><th class=\"word\">setting</th><th class=\"word\"></th><th class=\"word\">published "
      "by</th><th>median, {}</th><th>99 %</th><th>99.9 %</th><th>largest</th>{}<th>flicker</th><th>lost</th><th>ms {} "
      "(range)</th><th>preparation, ms</th><th>memory</th><th>disk</th></tr>\n",
      axis.choices.size(), unit_name(axis.unit), light ? "" : "<th>99 %, arcmin</th>", escaped(axis.time));
  const std::vector<ReportSeries> series = series_of(axis);
  for (const Measurement& choice : axis.choices) {
    text += choice.best_ready ? "<tr class=\"best\">" : "<tr>";
    text += fmt::format("<td>{}</td>", series_number(series, choice));
    for (const std::string* const word : {&choice.method, &choice.setting, &choice.precision, &choice.published}) {
      text += "<td class=\"word\">" + escaped(*word) + "</td>";
    }
    std::vector<std::string> cells = {error_number(axis, choice.error.median), error_number(axis, choice.error.p99),
                                      error_number(axis, choice.error.p999), error_number(axis, choice.error.largest)};
    if (!light) {
      cells.push_back(arcmin_text(report, choice.error.p99));
    }
    cells.push_back(choice.flicker ? error_number(axis, *choice.flicker) : "");
    cells.push_back(choice.lost > 0.0 ? short_number(100.0 * choice.lost) + " %" : "");
    cells.push_back(spread_text(spread_of(choice.frame_ms)));
    cells.push_back(choice.prepare_ms.empty() ? "" : short_number(spread_of(choice.prepare_ms).median));
    cells.push_back(choice.memory_bytes > 0 ? bytes_text(choice.memory_bytes) : "");
    cells.push_back(choice.disk_bytes ? bytes_text(*choice.disk_bytes) : "");
    for (const std::string& cell : cells) {
      text += "<td>" + cell + "</td>";
    }
    text += "</tr>\n";
  }
  return text + "</table></div>\n" + columns_caption + "</details>\n";
}

std::string equal_error_text(const AccuracyAxis& axis, double max_px) {
  if (axis.unit == ErrorUnit::light || axis.base.empty()) {
    return {};
  }
  std::string text = fmt::format(
      "<p>The fastest setting of each method with an error of at most {} (99 % of the pixels), and its time relative "
      "to {}, compared in the same rounds:</p>\n<div class=\"wide\"><table><tr><th class=\"word\">method</th><th "
      "class=\"word\">published by</th><th class=\"word\">setting</th><th>ms {}</th><th>time ratio (range)</th></tr>\n",
      error_text(axis, max_px), escaped(axis.base), escaped(axis.time));
  for (const EqualErrorRow& row : compare_at(axis, max_px, FrameCost::ready)) {
    const Measurement* const choice = row.choice;
    text += "<tr><td class=\"word\">" + escaped(row.method) + "</td>";
    text += choice == nullptr
                ? std::string("<td></td><td class=\"word\">no setting is accurate enough</td><td></td><td></td></tr>\n")
                : fmt::format("<td class=\"word\">{}</td><td class=\"word\">{}</td><td>{}</td><td>{}</td></tr>\n",
                              escaped(choice->published),
                              escaped(choice->setting + (choice->precision.empty() ? "" : ", " + choice->precision)),
                              short_number(cost_ms(*choice, FrameCost::ready)), spread_text(row.ratio));
  }
  return text + "</table></div>\n";
}

//! Returns an HTML table of the time of each pass of a frame, for the choices for which it was
//! measured. Empty if it was measured for no choice.
std::string passes_text(const AccuracyAxis& axis) {
  std::string text;
  for (const Measurement& choice : axis.choices) {
    if (choice.passes_ms.empty()) {
      continue;
    }
    text += "<tr><td class=\"word\">" + escaped(choice_name(choice)) + "</td><td class=\"word\">";
    std::string passes;
    for (const auto& [name, time_ms] : choice.passes_ms) {
      passes += passes.empty() ? "" : "; ";
      passes += fmt::format("{} {}", escaped(name), short_number(time_ms));
    }
    text += passes + "</td></tr>\n";
  }
  return text.empty() ? text
                      : "<details><summary>Time of each rendering pass, in ms</summary><div class=\"wide\"><table>\n" +
                            text + "</table></div></details>\n";
}

//! Returns the summary: the first sentence of each axis with more than five choices.
std::string in_short(const AccuracyReport& report) {
  std::string text = "<h2>Summary</h2>\n<div class=\"says\">\n";
  for (const AccuracyAxis& axis : report.axes) {
    const std::vector<std::string> sentences = axis_sentences(axis);
    if (!sentences.empty() && axis.choices.size() > 5) {
      text += "<p><b>" + escaped(axis.title) + ".</b> " + escaped(sentences.front()) + "</p>\n";
    }
  }
  return text + "</div>\n<p class=\"caption\">The sections below explain each method.</p>\n" + published_methods;
}

std::string axis_text(const AccuracyReport& report, const AccuracyAxis& axis, const std::vector<ReportPlot>& plots,
                      double max_px) {
  std::string text = "<h2>" + escaped(axis.title) + "</h2>\n";
  const std::vector<std::string> sentences = axis_sentences(axis);
  if (!sentences.empty()) {
    text += "<div class=\"says\">\n";
    for (const std::string& sentence : sentences) {
      text += "<p>" + escaped(sentence) + "</p>\n";
    }
    text += "</div>\n";
  }
  text += legend_text(axis);
  for (const ReportPlot& plot : plots) {
    if (plot.axis == axis.name) {
      text += fmt::format(
          "<img class=\"plot\" src=\"{}\" alt=\"plot of the error over the time\">\n<p class=\"caption\">{}</p>\n",
          escaped(plot.file), escaped(plot.caption));
    }
  }
  text += equal_error_text(axis, max_px);
  text += pictures_text(axis);
  text += "<p class=\"caption\">Errors are measured against " + escaped(axis.reference) + ".</p>\n";
  return text + table_of(report, axis) + passes_text(axis);
}

}  // namespace

std::string page_text(const AccuracyReport& report, const std::vector<ReportPlot>& plots, double max_px) {
  std::string text = head_text(report);
  text += fmt::format("<p class=\"{}\">{}</p>\n", is_too_busy(report) ? "busy" : "facts",
                      escaped(repeatability_words(report)));
  text += in_short(report);
  for (const AccuracyAxis& axis : report.axes) {
    text += axis_text(report, axis, plots, max_px);
  }
  if (!report.notes.empty()) {
    text += "<h2>Notes and limits</h2>\n<ul>\n";
    for (const std::string& note : report.notes) {
      text += "<li>" + escaped(note) + "</li>\n";
    }
    text += "</ul>\n";
  }
  text += fmt::format(
      "<p class=\"facts\">Made by <code>ergodome accuracy</code> in {:.0f} seconds. The same numbers for programs: <a "
      "href=\"accuracy.csv\">accuracy.csv</a>, <a href=\"accuracy.json\">accuracy.json</a>.</p>\n</body></html>\n",
      report.took_s);
  return text;
}

}  // namespace ergodome
