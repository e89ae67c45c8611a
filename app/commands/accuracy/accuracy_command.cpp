#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>

#include "app/cli/commands.h"
#include "app/cli/interrupt.h"
#include "app/cli/option_checks.h"
#include "app/cli/show_loading.h"
#include "app/cli/show_options.h"
#include "app/cli/usage_error.h"
#include "app/commands/accuracy/report_files.h"
#include "app/commands/accuracy/report_table.h"
#include "content/files/atomic_file.h"
#include "content/files/console.h"
#include "kernels/core/error.h"
#include "render/accuracy/accuracy.h"

namespace ergodome {

namespace {

struct AccuracyOptions {
  std::string show;
  ShowSettings set;
  std::string out;
  std::string at = "0.1px";
  std::vector<std::string> axes;
  int size_px = 0;
  int moments = 0;
  int rounds = 0;
  bool quick = false;
  bool json = false;
};

AccuracySettings settings_of(const AccuracyOptions& options) {
  AccuracySettings settings = options.quick ? quick_settings() : AccuracySettings{};
  settings.size_px = options.size_px;
  settings.axes = options.axes;
  settings.moments = options.moments > 0 ? options.moments : settings.moments;
  settings.rounds = options.rounds > 0 ? options.rounds : settings.rounds;
  return settings;
}

//! Runs the measurement. On a terminal, a progress line on stderr shows what is being measured.
AccuracyReport measure_with_progress(const Show& show, const AccuracySettings& settings) {
  const bool on_terminal = isatty(STDERR_FILENO) != 0;
  const AccuracyReport report = measure_accuracy(show, settings, [&](const std::string& doing) {
    if (on_terminal) {
      std::fputs(("\r\033[K" + doing).c_str(), stderr);
    }
    return !interrupted();
  });
  if (on_terminal) {
    std::fputs("\r\033[K", stderr);
  }
  return report;
}

void run(const AccuracyOptions& options) {
  const double at_px = pixels_of("--at", options.at);
  const Show show = load_show(options.show, options.set);
  require_features(show);
  const auto measured = accuracy_axes(show, settings_of(options));
  if (measured.empty()) {
    throw UsageError(options.show, "has nothing to measure for these --axes",
                     "omit --axes to measure everything that the show has");
  }
  for (const std::string& asked : options.axes) {
    if (std::ranges::find(measured, asked) == measured.end()) {
      print_note("{} has nothing to measure for --axes {}", show.name, asked);
    }
  }
  if (!options.out.empty()) {
    make_folder(options.out);
  }
  AccuracyReport report = measure_with_progress(show, settings_of(options));
  if (!options.out.empty()) {
    write_report_folder(report, at_px, options.out);
  }
  print_out("{}", options.json ? json_text(report) : table_text(report, at_px));
  if (!options.out.empty() && !options.json) {
    print_out("\nReport: {}\n", (std::filesystem::path(options.out) / "report.html").string());
  }
}

}  // namespace

void add_accuracy_command(CLI::App& app) {
  auto options = std::make_shared<AccuracyOptions>();
  CLI::App* command = app.add_subcommand("accuracy",
                                         "Measure how much time accuracy costs for a show on this machine; prints a "
                                         "table and, with --out, writes a report page");
  command->add_option("show", options->show, "show file (.toml) or name of a built-in show")->required();
  add_set_option(*command, options->set);
  command->add_option("--out", options->out, "folder for report.html, accuracy.csv and accuracy.json");
  command->add_flag("--quick", options->quick,
                    "finish in about a minute: smaller pictures, one moment of the show, fewer choices");
  command
      ->add_option("--size", options->size_px,
                   "width of the pictures in pixels (default: that of the show, at most 1024)")
      ->check(CLI::Range(16, 8192));
  command
      ->add_option("--moments", options->moments,
                   "number of moments of the show to measure (default: 3; 1 with --quick)")
      ->check(CLI::Range(1, 100));
  command->add_option("--rounds", options->rounds, "timed runs of each choice (default: 5; 3 with --quick)")
      ->check(CLI::Range(1, 1000));
  command->add_option("--axes", options->axes, "measure only these kinds of choices (default: all that the show has)")
      ->delimiter(',')
      ->check(CLI::IsMember(std::vector<std::string>(accuracy_axis_names.begin(), accuracy_axis_names.end())));
  command->add_option("--at", options->at, "error at which methods are compared")->capture_default_str();
  command->add_flag("--json", options->json, "print JSON instead of the table");
  IgnoredOptions ignored(*command);
  ignored.add("with --json, without --out", [options] { return options->json && options->out.empty(); }, {"--at"});
  command->callback([options, ignored] {
    ignored.refuse();
    run(*options);
  });
}

}  // namespace ergodome
