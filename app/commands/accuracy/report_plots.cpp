#include "app/commands/accuracy/report_plots.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <string_view>
#include <utility>
#include <vector>

#include "content/files/atomic_file.h"
#include "kernels/core/error.h"

extern char** environ;  // NOLINT: POSIX's name

namespace ergodome {

namespace {

//! Returns the color of a method's lines. Listed methods have the same color in all plots; others
//! cycle through four colors by `number`.
const char* colour_of(const std::string& method, std::size_t number) {
  constexpr std::array<std::pair<std::string_view, const char*>, 10> known = {{{"conforming grid", "#009e73"},
                                                                               {"quadtree, linear", "#e69f00"},
                                                                               {"quadtree, spline", "#d55e00"},
                                                                               {"quadtree", "#d55e00"},
                                                                               {"direct rays", "#0072b2"},
                                                                               {"taylor", "#56b4e9"},
                                                                               {"cash_karp", "#cc79a7"},
                                                                               {"baseline_rk34", "#8c564b"},
                                                                               {"rk34", "#6a3d9a"},
                                                                               {"closed_form", "#333333"}}};
  constexpr std::array others = {"#0072b2", "#d55e00", "#009e73", "#cc79a7"};
  const auto* const found = std::ranges::find_if(known, [&](const auto& entry) { return entry.first == method; });
  return found != known.end() ? found->second : others[number % others.size()];
}

//! Errors below these limits [px, %] are negligible and are drawn at the limit.
constexpr double min_px = 1e-4;
constexpr double min_percent = 1e-3;

double drawn_error(const AccuracyAxis& axis, const Measurement& choice) {
  return axis.unit == ErrorUnit::light ? std::max(100.0 * choice.error.p99, min_percent)
                                       : std::max(choice.error.p99, min_px);
}

std::string points_of(const AccuracyAxis& axis, FrameCost cost, const std::vector<const Measurement*>& choices) {
  std::string text;
  for (const Measurement* const choice : choices) {
    const Spread time = spread_of(cost == FrameCost::ready ? choice->frame_ms : choice->anew_ms());
    const double error = drawn_error(axis, *choice);
    if (time.runs > 0 && std::isfinite(error)) {
      text += fmt::format("{:.6g} {:.6g} {:.6g} {:.6g}\n", time.median, error, time.minimum, time.maximum);
    }
  }
  return text;
}

//! Returns gnuplot's point type of a series. Double precision: a triangle. Otherwise: a square for
//! published methods, a disk for others. The points of published methods are hollow.
int point_of(const ReportSeries& series) {
  const bool wide = series.choices.front()->precision == "double";
  return series.published ? (wide ? 8 : 4) : (wide ? 9 : 7);
}

//! Returns text in gnuplot's double quotes, without characters that have a meaning there.
std::string quoted(const std::string& text) {
  std::string safe = "\"";
  for (const char letter : text) {
    safe += letter == '"' || letter == '\\' || letter == '\n' || letter == '`' ? ' ' : letter;
  }
  return safe + '"';
}

std::string frame_of(const AccuracyAxis& axis, FrameCost cost, const std::filesystem::path& picture) {
  std::string text =
      "set terminal svg size 640,480 dynamic font \"DejaVu Sans,16\" background \"white\"\n"
      "set encoding utf8\nset logscale xy\nset grid back lc rgb \"#dddddd\"\nset border lc rgb \"#888888\"\n"
      "set key off\nset format \"%g\"\n";
  text += "set output " + quoted(picture.string()) + "\n";
  const bool ready = cost == FrameCost::ready;
  const std::string when = ready ? " (left is faster)" : ", with preparation (left is faster)";
  text += "set xlabel " + quoted("milliseconds " + axis.time + when) + "\n";
  text += axis.unit == ErrorUnit::light ? "set ylabel \"error of the light, percent (lower is better)\"\n"
                                        : "set ylabel \"error on the screen, pixels (lower is better)\"\n";
  if (axis.unit != ErrorUnit::light) {
    for (const auto& [error, name] :
         {std::pair(1.0, "one pixel"), std::pair(0.25, "a quarter"), std::pair(0.1, "a tenth")}) {
      text += fmt::format(
          "set label \"{}\" at graph 0.99,first {} right offset 0,0.5 tc rgb \"#777777\" font \",14\"\n", name, error);
      text += fmt::format("set arrow from graph 0,first {0} to graph 1,first {0} nohead lc rgb \"#bbbbbb\"\n", error);
    }
  }
  return text;
}

int run_gnuplot(const std::filesystem::path& script, const std::filesystem::path& messages) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, messages.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  std::string program = "gnuplot";
  std::string file = script.string();
  std::array<char*, 3> words = {program.data(), file.data(), nullptr};
  pid_t process = 0;
  const int problem = posix_spawnp(&process, "gnuplot", &actions, nullptr, words.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (problem != 0) {
    return -1;
  }
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  // Status 127 also means that gnuplot is missing: a shell script that starts it would exit with
  // this status.
  return WIFEXITED(status) ? (WEXITSTATUS(status) == 127 ? -1 : WEXITSTATUS(status)) : 1;
}

std::string first_line_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string line;
  while (std::getline(stream, line) && line.find_first_not_of(" \t^") == std::string::npos) {
  }
  return line.substr(0, 200);
}

}  // namespace

std::vector<ReportSeries> series_of(const AccuracyAxis& axis) {
  std::vector<ReportSeries> all;
  for (const Measurement& choice : axis.choices) {
    std::string name = choice.method;
    if (!choice.precision.empty()) {
      name += ", " + choice.precision;
    }
    if (!choice.published.empty()) {
      name += " (" + choice.published + ")";
    }
    auto found = std::ranges::find_if(all, [&](const ReportSeries& series) { return series.name == name; });
    if (found == all.end()) {
      const std::size_t before = all.size();
      all.push_back(
          {static_cast<int>(before) + 1, name, colour_of(choice.method, before), !choice.published.empty(), {}});
      found = all.end() - 1;
    }
    found->choices.push_back(&choice);
  }
  return all;
}

bool is_plottable(const AccuracyAxis& axis) {
  const auto drawn = [](const Measurement& choice) {
    return std::isfinite(choice.error.p99) && !choice.frame_ms.empty();
  };
  return std::ranges::count_if(axis.choices, drawn) >= 2;
}

std::string plot_script(const AccuracyAxis& axis, FrameCost cost, const std::filesystem::path& picture) {
  std::string text = frame_of(axis, cost, picture);
  std::string plots;
  std::vector<const Measurement*> best;
  for (const Measurement& choice : axis.choices) {
    if (cost == FrameCost::ready ? choice.best_ready : choice.best_anew) {
      best.push_back(&choice);
    }
  }
  const std::string best_points = points_of(axis, cost, best);
  if (!best_points.empty()) {
    text += "$best << EOD\n" + best_points + "EOD\n";
    plots += "$best using 1:2 with points pt 6 ps 2.2 lw 2 lc rgb \"#000000\"";
  }
  for (const ReportSeries& series : series_of(axis)) {
    const std::string points = points_of(axis, cost, series.choices);
    if (points.empty()) {
      continue;
    }
    text += fmt::format("$s{} << EOD\n{}EOD\n", series.number, points);
    plots += plots.empty() ? "" : ", \\\n  ";
    plots += fmt::format(
        "$s{0} using 1:2 with linespoints lc rgb \"{1}\" lw 1.6 dt {2} pt {3} ps 0.9, \\\n"
        "  $s{0} using 1:2:3:4 with xerrorbars lc rgb \"{1}\" pt 0 lw 0.8, \\\n"
        "  $s{0} using 1:2:(\"{0}\") every ::0::0 with labels offset char 0.9,0.7 font \",17\" tc rgb \"{1}\"",
        series.number, series.colour, series.published ? 2 : 1, point_of(series));
  }
  return text + "plot " + plots + "\n";
}

bool draw_plot(const AccuracyAxis& axis, FrameCost cost, const std::filesystem::path& picture) {
  std::filesystem::path script = picture;
  script.replace_filename(".script-" + picture.filename().string());
  std::filesystem::path messages = picture;
  messages.replace_filename(".messages-" + picture.filename().string());
  int status = 0;
  std::string message;
  const auto draw = [&](const std::filesystem::path& partial) {
    std::ofstream(script, std::ios::binary) << plot_script(axis, cost, partial);
    status = run_gnuplot(script, messages);
    message = first_line_of(messages);
    std::error_code ignored;
    std::filesystem::remove(script, ignored);
    std::filesystem::remove(messages, ignored);
    if (status > 0) {
      throw Error(picture.string(), "gnuplot could not draw it: " + message,
                  "check the folder and the gnuplot installation");
    }
    if (status < 0) {
      std::ofstream(partial, std::ios::binary) << "<svg xmlns=\"http://www.w3.org/2000/svg\"/>\n";
    }
  };
  write_atomically(picture, draw);
  if (status < 0) {
    std::error_code ignored;
    std::filesystem::remove(picture, ignored);
  }
  return status == 0;
}

}  // namespace ergodome
