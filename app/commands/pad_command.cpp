#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <thread>

#include "app/cli/commands.h"
#include "app/cli/interrupt.h"
#include "app/cli/option_checks.h"
#include "app/commands/pad_listing.h"
#include "app/pads/hid/hid_fixture.h"
#include "app/pads/pad_calibration.h"
#include "app/pads/pad_hub.h"
#include "app/pads/pad_lines.h"
#include "content/files/console.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

namespace fs = std::filesystem;

constexpr double frame_s = 1.0 / 60.0;

struct PadOptions {
  bool live = false;
  bool calibrate = false;
  int pad = 1;
  double for_s = 0.0;
  std::string out;
  std::string settings;
  std::string fixture;
};

//! The time of live output: real time, or, when a fixture is played and the output is not a
//! terminal, time that advances by 1/60 s with each frame, without waiting.
class Pace {
 public:
  explicit Pace(bool hurry) : hurry_(hurry), start_(Clock::now()) {}

  [[nodiscard]] double now_s() const {
    return hurry_ ? time_s_ : std::chrono::duration<double>(Clock::now() - start_).count();
  }
  void next_frame() {
    if (hurry_) {
      time_s_ += frame_s;
    } else {
      std::this_thread::sleep_for(std::chrono::duration<double>(frame_s));
    }
  }

 private:
  using Clock = std::chrono::steady_clock;
  bool hurry_;
  double time_s_ = 0.0;
  Clock::time_point start_;
};

//! Returns the settings file: the one named, or the default file if it exists; otherwise an empty
//! path.
fs::path settings_file(const PadOptions& options) {
  if (!options.settings.empty()) {
    return options.settings;
  }
  const fs::path path = default_pad_settings_path();
  std::error_code problem;
  return !path.empty() && fs::exists(path, problem) ? path : fs::path();
}

PadSettings read_settings(const PadOptions& options) {
  const fs::path path = settings_file(options);
  return path.empty() ? PadSettings{} : load_pad_settings(path);
}

std::unique_ptr<HidApi> open_api(const PadOptions& options, const Pace& pace) {
  std::unique_ptr<HidApi> api =
      options.fixture.empty()
          ? make_hid_library()
          : std::make_unique<FixturePlayer>(load_hid_fixture(options.fixture), [&pace] { return pace.now_s(); });
  if (const std::string problem = api->init(); !problem.empty()) {
    throw Error("pad", problem, "install libhidapi-hidraw");
  }
  return api;
}

//! Redraws lines in place on a terminal; otherwise appends the lines that changed.
class LiveLines {
 public:
  void show(const PadSnapshot& snapshot) {
    std::vector<std::string> lines;
    lines.reserve(snapshot.pads.size());
    for (const PadView& pad : snapshot.pads) {
      lines.push_back(live_line(pad));
    }
    if (lines == shown_) {
      return;
    }
    on_terminal_ ? redraw(lines) : append(lines);
    std::fflush(stdout);
    shown_ = std::move(lines);
  }

 private:
  void redraw(const std::vector<std::string>& lines) const {
    if (!shown_.empty()) {
      std::fputs(fmt::format("\x1b[{}A\x1b[J", shown_.size()).c_str(), stdout);
    }
    for (const std::string& line : lines) {
      print_out("{}\n", line);
    }
  }

  void append(const std::vector<std::string>& lines) const {
    for (const std::string& line : lines) {
      if (std::find(shown_.begin(), shown_.end(), line) == shown_.end()) {
        print_out("{}\n", line);
      }
    }
  }

  bool on_terminal_ = ::isatty(STDOUT_FILENO) != 0;
  std::vector<std::string> shown_;
};

//! Returns how long a command runs [s]: --for if given; otherwise 10 s for a fixture whose output
//! is not a terminal (`hurry`), and `otherwise` in other cases.
double duration_s(const PadOptions& options, bool hurry, double otherwise) {
  return options.for_s > 0.0 ? options.for_s : hurry ? 10.0 : otherwise;
}

void show_live(PadHub& hub, Pace& pace, double duration_s) {
  LiveLines lines;
  const double end_s = pace.now_s() + duration_s;
  while (pace.now_s() < end_s && !interrupted()) {
    hub.poll();
    lines.show(hub.snapshot());
    pace.next_frame();
  }
}

//! Returns the session of the pad with this number, from 1 in the order of discovery; null if there
//! is none.
const PadSession* session_of(const PadHub& hub, int number) {
  const auto index = static_cast<std::size_t>(number - 1);
  return index < hub.sessions().size() ? hub.sessions()[index].get() : nullptr;
}

//! Returns the profile for exactly this device and serial number. If it is missing, adds a copy of
//! the profile that applied to the pad before.
PadProfile& own_profile(PadSettings& settings, const PadIdentity& pad) {
  const std::string device = device_id(pad.vendor, pad.product);
  const auto found = std::find_if(settings.pads.begin(), settings.pads.end(), [&](const PadProfile& profile) {
    return profile.device == device && profile.serial == pad.serial;
  });
  if (found != settings.pads.end()) {
    return *found;
  }
  PadProfile profile = profile_for(settings, pad);
  profile.device = device;
  profile.name.clear();
  profile.serial = pad.serial;
  settings.pads.push_back(std::move(profile));
  return settings.pads.back();
}

fs::path calibration_file(const PadOptions& options) {
  fs::path path = !options.out.empty()        ? fs::path(options.out)
                  : !options.settings.empty() ? fs::path(options.settings)
                                              : default_pad_settings_path();
  if (path.empty()) {
    throw Error("pad --calibrate", "no home folder was found for the settings file", "name a file with --out");
  }
  return path;
}

void report(const PadProfile& profile, const std::vector<std::string>& unmoved) {
  for (const auto& [name, range] : profile.calibration) {
    print_out("{:>16}: {} to {}, center {}\n", name, range.minimum, range.maximum, range.centre);
  }
  print_out("dead zones: left stick {}, right stick {}\n", profile.left_stick.dead_zone, profile.right_stick.dead_zone);
  if (!unmoved.empty()) {
    print_out("unchanged, because they were hardly moved: {}\n", fmt::join(unmoved, ", "));
  }
}

void calibrate(PadHub& hub, Pace& pace, PadSettings settings, const PadOptions& options, double duration_s) {
  const fs::path file = calibration_file(options);
  print_out(
      "Do not touch the controller for a moment. Then move each stick all the way round, press both triggers fully,\n"
      "and release everything: this ends the calibration. Ctrl-C cancels it without changes.\n");
  std::fflush(stdout);
  const double end_s = pace.now_s() + duration_s;
  std::unique_ptr<PadCalibrator> calibrator;
  const PadSession* session = nullptr;
  while (pace.now_s() < end_s && !interrupted()) {
    hub.poll();
    if (const PadSession* const now = session_of(hub, options.pad); now != session) {
      session = now;
      calibrator = now != nullptr ? std::make_unique<PadCalibrator>(now->layout()) : nullptr;
    }
    if (calibrator != nullptr && session->reports() > 0) {
      calibrator->take(session->raw(), pace.now_s());
      if (calibrator->is_done(pace.now_s())) {
        PadProfile& profile = own_profile(settings, *session->identity());
        profile = calibrator->applied_to(profile);
        report(profile, calibrator->unmoved());
        write_pad_settings(file, settings);
        print_out("settings written to {}\n", file.string());
        return;
      }
    }
    pace.next_frame();
  }
  throw Error(
      "pad --calibrate",
      session == nullptr ? "this controller was not found" : "the controller was not moved and then released in time",
      "nothing was written; list the controllers with `ergodome pad`, then try again");
}

void run(const PadOptions& options) {
  const bool hurry = !options.fixture.empty() && ::isatty(STDOUT_FILENO) == 0;
  Pace pace(hurry);
  const PadSettings settings = read_settings(options);
  std::unique_ptr<HidApi> api = open_api(options, pace);
  constexpr double for_ever_s = 1e9;
  if (options.calibrate) {
    PadHub hub(std::move(api), settings, [&] { return pace.now_s(); });
    calibrate(hub, pace, settings, options, duration_s(options, hurry, 120.0));
  } else if (options.live) {
    PadHub hub(std::move(api), settings, [&] { return pace.now_s(); });
    show_live(hub, pace, duration_s(options, hurry, for_ever_s));
  } else if (!options.out.empty()) {
    write_pads_found(*api, settings, options.out);
  } else {
    list_pads(*api, settings, settings_file(options));
  }
}

}  // namespace

void add_pad_command(CLI::App& app) {
  auto* command =
      app.add_subcommand("pad", "List game controllers, show their live input, calibrate them, write their settings");
  auto options = std::make_shared<PadOptions>();
  auto* live = command->add_flag("--live", options->live, "show the live values of sticks and buttons until Ctrl-C");
  auto* calibrate =
      command
          ->add_flag("--calibrate", options->calibrate,
                     "measure the ranges of a controller's sticks and triggers and write them to the settings file")
          ->excludes(live);
  command->add_option("--pad", options->pad, "number of the controller to calibrate, in the order of the list, from 1")
      ->check(CLI::Range(1, 16))
      ->needs(calibrate);
  command->add_option("--for", options->for_s, "end after this number of seconds")->check(number_between(0.1, 1e9));
  command->add_option("--settings", options->settings,
                      "settings file to read (default: ergodome/pads.toml in $XDG_CONFIG_HOME or ~/.config)");
  command
      ->add_option("--out", options->out, "settings file to write, with comments; an existing file is renamed to .bak")
      ->excludes(live);
  command->add_option("--fixture", options->fixture,
                      "replay recorded reports from this file instead of reading controllers");
  IgnoredOptions ignored(*command);
  ignored.add("without --live or --calibrate", [options] { return !options->live && !options->calibrate; }, {"--for"});
  command->callback([options, ignored] {
    ignored.refuse();
    run(*options);
  });
}

}  // namespace ergodome
