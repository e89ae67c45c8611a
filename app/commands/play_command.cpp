#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <memory>
#include <optional>
#include <sstream>
#include <utility>

#include "app/budget/play_budget.h"
#include "app/cli/backend_choice.h"
#include "app/cli/commands.h"
#include "app/cli/lens_options.h"
#include "app/cli/option_checks.h"
#include "app/cli/output_file.h"
#include "app/cli/setup_show.h"
#include "app/cli/show_loading.h"
#include "app/cli/show_options.h"
#include "app/cli/usage_error.h"
#include "app/exhibit/log_file.h"
#include "app/exhibit/saved_settings.h"
#include "app/exhibit/supervisor.h"
#include "app/playback/midi_time_code.h"
#include "app/player/outputs/dome_output.h"
#include "app/player/outputs/headset_output.h"
#include "app/player/player.h"
#include "app/player/recording/numbered_records.h"
#include "app/player/renderers/play_renderers.h"
#include "content/files/console.h"
#include "content/files/whole_file.h"
#include "content/show/animatable_number.h"
#include "render/output/stereo_layout.h"

namespace ergodome {

namespace {

struct PlayArguments : ShowOverrides {
  std::string show;
  std::string backend = "auto";
  std::string setup;
  std::optional<ProjectorOptions> projectors;  //!< projectors of the dome setup; empty without --setup
  bool hide_control = false;
  bool cluster = false;  //!< nodes show the dome too
  bool push_content = false;
  std::string frame_log;  //!< file for FrameLog; empty: none
  bool headset = false;
  std::optional<double> headset_scale;  //!< replaces HeadsetSettings::scale
  bool full_screen = false;
  bool size_given = false;
  bool tint_eyes = false;
  bool exhibit = false;
  ExhibitOptions exhibit_options;
  std::string new_controls;
  LensOptions lens;
  std::vector<std::string> budget;
  PlayOptions options;
};

//! Returns the keys for --help, one line each.
std::string key_help() {
  std::string text = "Keys:\n";
  std::istringstream lines(help_text(Controls(), {.pads = false}));
  for (std::string line; std::getline(lines, line);) {
    text += fmt::format("  {}\n", line);
  }
  text.pop_back();
  return text;
}

//! Reads the dome setup and prepares its projectors. Without --size, pictures get the size of the
//! domemaster that the projectors need.
void use_setup(PlayArguments& arguments) {
  ProjectorOptions& projectors = arguments.projectors.emplace();
  projectors.setup = read_dome_setup(arguments.setup);
  projectors.pictures = projector_pictures(projectors.setup);
  projectors.master_px = enough_master_px(projectors.pictures);
  projectors.hide_control = arguments.hide_control;
  if (arguments.cluster) {
    arguments.options.cluster =
        std::make_shared<ClusterGate>(projectors.setup, projectors.master_px, arguments.frame_log);
    if (arguments.push_content) {
      arguments.options.cluster->push_content();
    }
    keep_projectors_of(projectors, "");
  } else if (!node_names(projectors.setup).empty()) {
    print_note("{} names projectors at nodes; their windows open here too, because --cluster is not given",
               arguments.setup);
  }
  if (!arguments.size_given) {
    arguments.options.size_px = projectors.master_px;
  }
}

//! Opens a headset. Without --size, pictures get the resolution of the headset.
std::unique_ptr<DisplayOutput> open_headset(PlayArguments& arguments) {
  HeadsetOptions headset;
  headset.mirror.size = {960, 720};
  headset.mirror.full_screen = arguments.full_screen || arguments.exhibit;
  headset.may_be_absent = arguments.exhibit;
  auto output = std::make_unique<HeadsetOutput>(headset);
  arguments.options.size_px = arguments.size_given ? cube_faces * arguments.options.size_px : output->fitting_size_px();
  return output;
}

//! Opens the output that shows the pictures of a show. Eyes that layouts store separately are side
//! by side in the window; those of quad_buffer and rows each fill it.
std::unique_ptr<DisplayOutput> open_output(PlayArguments& arguments, const Show& show) {
  if (arguments.headset) {
    return open_headset(arguments);
  }
  const Projection projection = make_projection(show.view, arguments.options.size_px, 0.0);
  const StereoLayout layout = show.stereo.layout;
  WindowOptions window;
  window.size = window_picture_size(layout, {projection.width_px, projection.height_px});
  window.full_screen = arguments.full_screen || arguments.exhibit;
  window.eye_buffers = layout == StereoLayout::quad_buffer;
  if (arguments.projectors) {
    // A master need not have projectors of its own: the control window then is its only window.
    return std::make_unique<DomeOutput>(window, *arguments.projectors);
  }
  return std::make_unique<WindowOutput>(window);
}

//! Loads a show and applies the options of the command line.
Show loaded_show(const PlayArguments& arguments, const std::string& name) {
  Show show = load_show(name, arguments.set);
  apply_overrides(show, arguments, arguments.projectors.has_value());
  if (has_face_files(show.view)) {
    // A window shows all faces in one image.
    show.view.cube_files = CubeFiles::cross;
  }
  if (arguments.headset) {
    show.headset.scale = arguments.headset_scale.value_or(show.headset.scale);
    fit_to_headset(show);
  }
  show.stereo.tint_eyes = show.stereo.tint_eyes || arguments.tint_eyes;
  if (arguments.projectors) {
    fit_to_setup(show, arguments.projectors->setup, arguments.stereo);
  }
  require_features(show);
  return show;
}

//! Throws UsageError if the show file has the name and folder of a recording made with --record: an
//! exhibit deletes its oldest recordings, and would delete the show.
void require_no_record(const std::string& record, const std::string& show) {
  std::error_code problem;
  const auto folder = [](const std::filesystem::path& file) {
    return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  };
  if (!record.empty() && record_number(record, show) &&
      std::filesystem::equivalent(folder(record), folder(show), problem)) {
    throw UsageError("--record " + record, show + " is named like a recording, and the oldest recordings are deleted",
                     "rename the show");
  }
}

std::filesystem::path exhibit_log() {
  const std::filesystem::path folder = state_folder();
  return folder.empty() ? folder : folder / "ergodome.log";
}

//! Prepares an exhibit, which stores its settings and its log in files.
void use_exhibit(PlayArguments& arguments, const Show& visitor) {
  PlayOptions& options = arguments.options;
  if (arguments.exhibit_options.attract.empty()) {
    arguments.exhibit_options.attract = usual_attract_show(visitor);
  }
  arguments.exhibit_options.state = state_folder();
  options.services.log_file = exhibit_log();
  if (arguments.exhibit_options.state.empty()) {
    print_note("settings and the log are not saved, because this user has no home folder; set HOME or XDG_STATE_HOME");
  }
  options.exhibit = arguments.exhibit_options;
}

//! Measures the show, chooses the settings that the budget leaves open, and prints them. Returns
//! the renderer used for this, so that the show can start with it; null without a budget.
std::shared_ptr<ShowRenderer> use_budget(PlayArguments& arguments, const Show& show, const RendererLoader::Make& make) {
  const Budget budget = parse_budget(arguments.budget);
  if (budget.empty()) {
    return nullptr;
  }
  PlayOptions& options = arguments.options;
  std::shared_ptr<ShowRenderer> renderer = make(show);
  const PlanWithText planned = plan_play(*renderer, show,
                                         {budget, options.size_px, arguments.size_given, lens_choice(arguments.lens),
                                          options.free_flight || arguments.exhibit});
  print_out("{}\n", planned.line);
  std::fflush(stdout);
  options.budget = planned.plan;
  return renderer;
}

void run(PlayArguments arguments) {
  if (!arguments.new_controls.empty()) {
    write_default_controls(arguments.new_controls);
    return;
  }
  PlayOptions& options = arguments.options;
  require_other_png("--screenshot", options.screenshot, {arguments.show, arguments.setup});
  if (!options.record.empty() && std::filesystem::path(options.record).extension() != ".toml") {
    throw UsageError("--record " + options.record, "does not end in .toml", "choose a name that ends in .toml");
  }
  require_output_file("--record", options.record, {arguments.show, arguments.setup, options.controls});
  options.free_flight = options.free_flight || arguments.show.empty();
  if (const std::filesystem::path state = state_folder(); !state.empty()) {
    options.services.remote.saved_token_file = state / "web-token";
  }
  if (!arguments.setup.empty()) {
    use_setup(arguments);
  }
  if (arguments.exhibit) {
    require_no_record(options.record, arguments.show);
    require_no_record(options.record, arguments.exhibit_options.attract);
  }
  options.load = [arguments](const std::string& name) { return loaded_show(arguments, name); };
  const std::string usual_show = arguments.exhibit ? usual_visitor_show : "free-flight";
  const Show show = options.load(arguments.show.empty() ? usual_show : arguments.show);
  if (arguments.exhibit) {
    use_exhibit(arguments, show);
  }
  if (!arguments.exhibit) {
    require_used_memory(show, arguments.lens);
  }
  if (!arguments.headset) {
    report_equal_eyes(show);
  }
  if (keeps_eyes_apart(show.stereo.layout) && !arguments.projectors && !arguments.headset) {
    print_note("the window shows stereo layout {} side by side; only render writes separate images",
               stereo_layout_names[static_cast<std::size_t>(show.stereo.layout)]);
  }
  const Backend backend = choose_backend(arguments.backend);
  std::unique_ptr<DisplayOutput> output = open_output(arguments, show);
  // With a budget, the line about the chosen settings reports on the lenses, so notes on a coarse
  // trajectory are omitted.
  const RendererLoader::Make make =
      renderer_maker({backend, arguments.backend == "auto", arguments.lens, options.size_px, arguments.budget.empty(),
                      options.notes, arguments.options.language});
  std::shared_ptr<ShowRenderer> first = use_budget(arguments, show, make);
  Player player(show, with_first(make, show.name, std::move(first)), std::move(output), options);
  player.run();
  // Makes threads that are still loading give up: the player did not wait for them.
  stop_reading();
}

//! Runs the player. In an exhibit, restarts after crashes and logs why it cannot start.
void run_logged(const PlayArguments& arguments) {
  if (arguments.exhibit) {
    restart_after_crashes();
  }
  try {
    run(arguments);
  } catch (const std::exception& problem) {
    if (arguments.exhibit) {
      open_log(exhibit_log(), {})->error("{}", problem.what());
    }
    throw;
  }
}

//! Throws UsageError if the show follows a clock from OSC but no OSC port is open.
void require_osc_port(const ServiceOptions& services) {
  if (services.clock == "osc" && !services.remote.osc_port) {
    throw UsageError("--clock osc", "needs an OSC port", "add --osc PORT");
  }
}

void add_picture_options(CLI::App& command, PlayArguments& arguments) {
  add_projection_options(command, arguments, "the setup's or the show's");
  add_objects_option(command, arguments);
  command.add_flag("--times", arguments.options.times_shown, "show frame time, lens, spin and camera position (key I)");
  command.add_flag("--quiet", arguments.options.quiet,
                   "show only texts requested with keys (F1, I); messages go to the log and the status page");
  add_stereo_options(command, arguments);
  command.add_flag("--tint-eyes", arguments.tint_eyes, "tint the left eye's image red and the right eye's cyan");
}

void add_dome_options(CLI::App& command, PlayArguments& arguments, IgnoredOptions& ignored) {
  command.option_defaults()->group("Domes");
  CLI::Option* const setup =
      command.add_option("--setup", arguments.setup, "dome setup (.toml): also open a window for each projector")
          ->type_name("FILE");
  command
      .add_flag("--no-control", arguments.hide_control,
                "with --setup: open only the projectors' windows; keys work in them")
      ->needs(setup);
  CLI::Option* const cluster =
      command.add_flag("--cluster", arguments.cluster, "with --setup: show the dome together with its nodes")
          ->needs(setup);
  command
      .add_flag("--push-content", arguments.push_content,
                "with --cluster: send files of the show to nodes that lack them")
      ->needs(cluster);
  command.add_option("--frame-log", arguments.frame_log, "with --cluster: list the shown frames in this CSV file")
      ->type_name("FILE")
      ->needs(cluster);
  ignored.add("with --setup, which fixes the projection",
              [&arguments] { return !arguments.setup.empty() && arguments.projection != "dome"; }, {"--projection"});
}

void add_headset_options(CLI::App& command, PlayArguments& arguments, IgnoredOptions& ignored) {
  command.option_defaults()->group("Headsets");
  CLI::Option* const headset = command.add_flag("--headset", arguments.headset,
                                                "show in a headset (OpenXR), with a mirror window for the operator");
  command
      .add_option("--headset-scale", arguments.headset_scale,
                  "length in the scene of one meter in the room (default: the show's) [M]")
      ->check(number_between(1e-9, 1e6))
      ->needs(headset);
  command
      .add_flag("!--no-haptics", arguments.options.haptics,
                "do not let controllers vibrate at the photon orbits and the horizon")
      ->needs(headset);
  command.add_flag("--guide", arguments.options.guide,
                   "visitors can only move forward and back; operators use the status page or OSC");
  ignored.add("with --headset, which shows the whole sky", [&arguments] { return arguments.headset; },
              {"--setup", "--projection", "--stereo"});
}

void add_control_options(CLI::App& command, PlayArguments& arguments) {
  command.option_defaults()->group("Keys and pads");
  command.add_option("--controls", arguments.options.controls, "read the assignment of keys, mouse and pads (.toml)")
      ->type_name("FILE");
  command.add_option("--write-controls", arguments.new_controls, "write the default assignment to this file, and quit")
      ->type_name("FILE");
  command.add_option("--pad-settings", arguments.options.pad_settings, "read pad settings made by ergodome pad")
      ->type_name("FILE");
  command.add_option("--pad-fixture", arguments.options.pad_fixture, "play recorded pad input instead of real pads")
      ->type_name("FILE");
}

void add_clock_and_sound_options(CLI::App& command, PlayArguments& arguments, IgnoredOptions& ignored) {
  command.option_defaults()->group("Clock and sound");
  ServiceOptions& services = arguments.options.services;
  command
      .add_option("--clock", services.clock, "source of the show's time: own, mtc (MIDI time code), mtc:PORT or osc")
      ->type_name("SOURCE")
      ->check([](const std::string& word) {
        const bool known = word == "own" || word == "osc" || word == "mtc" || word.rfind("mtc:", 0) == 0;
        return known ? std::string() : "\"" + word + "\" is not a clock; choose own, mtc, mtc:PORT or osc";
      })
      ->capture_default_str();
  command.add_option("--clock-start", services.clock_start, "with --clock mtc: time code at the start of the show")
      ->type_name("TIMECODE")
      ->check([](const std::string& text) {
        const bool known = parse_time_code(text, CodeRate::fps30).has_value();
        return known
                   ? std::string()
                   : "\"" + text + "\" is not a time code; write hours, minutes, seconds and frames, as in 01:00:00:00";
      })
      ->capture_default_str();
  CLI::Option* const no_sound = command.add_flag("!--no-sound", services.sound, "play no sound");
  command.add_option("--sound-later", services.sound_later_s, "delay sound by N seconds, for slow displays")
      ->check(number_between(-1.0, 1.0))
      ->excludes(no_sound);
  ignored.add("without --clock mtc", [&services] { return !services.clock.starts_with("mtc"); }, {"--clock-start"});
}

void add_exhibit_options(CLI::App& command, PlayArguments& arguments, IgnoredOptions& ignored) {
  command.option_defaults()->group("Exhibits");
  ExhibitOptions& exhibit = arguments.exhibit_options;
  CLI::Option* const locked = command.add_flag(
      "--exhibit", arguments.exhibit, "run locked and full screen: an attract show, and free flight for each visitor");
  command
      .add_option("--attract", exhibit.attract,
                  "with --exhibit: the attract show (default: attract; for domes once-around)")
      ->type_name("SHOW")
      ->needs(locked);
  command.add_option("--idle", exhibit.times.idle_s, "with --exhibit: end a flight after N seconds without input")
      ->check(number_between(1.0, 86400.0))
      ->needs(locked)
      ->capture_default_str();
  command.add_option("--session", exhibit.times.session_s, "with --exhibit: end a flight after N seconds; 0: no limit")
      ->check(number_between(0.0, 86400.0))
      ->needs(locked)
      ->capture_default_str();
  ignored.add("with --exhibit, which starts free flight for each visitor", [&arguments] { return arguments.exhibit; },
              {"--fly"});
}

}  // namespace

void add_play_command(CLI::App& app) {
  auto arguments = std::make_shared<PlayArguments>();
  CLI::App* command = app.add_subcommand("play", "Play a show or fly freely in a window");
  command->footer(key_help());
  command->add_option("show", arguments->show, "show file (.toml) or name of a built-in show (default: free flight)");
  add_set_option(*command, arguments->set);
  const CLI::Option* const size =
      command->add_option("--size", arguments->options.size_px, "width of one eye's image in pixels")
          ->check(CLI::Range(16, 8192))
          ->capture_default_str();
  command->add_flag("--full-screen", arguments->full_screen, "fill the monitor");
  command->add_flag("--fly", arguments->options.free_flight, "start in free flight");
  command->add_option("--for", arguments->options.for_seconds, "quit N seconds after the first frame")
      ->check(number_between(0.0, 1e9));
  command->add_option("--language", arguments->options.language, "language of captions and narration, as en or de")
      ->type_name("TAG");
  command->add_option("--record", arguments->options.record, "write the flight to this show file (.toml)")
      ->type_name("FILE");
  command->add_option("--screenshot", arguments->options.screenshot, "save the last picture of the window to this PNG")
      ->type_name("FILE");
  IgnoredOptions ignored(*command);
  add_picture_options(*command, *arguments);
  add_dome_options(*command, *arguments, ignored);
  add_headset_options(*command, *arguments, ignored);
  add_backend_option(*command, arguments->backend);
  add_lens_options(*command, arguments->lens, ignored);
  add_budget_option(*command, arguments->budget);
  add_control_options(*command, *arguments);
  add_clock_and_sound_options(*command, *arguments, ignored);
  command->option_defaults()->group("Remote control");
  add_remote_options(*command, arguments->options.services.remote);
  add_exhibit_options(*command, *arguments, ignored);
  command->callback([arguments, size, ignored] {
    ignored.refuse();
    require_osc_port(arguments->options.services);
    arguments->size_given = size->count() > 0;
    run_logged(*arguments);
  });
}

}  // namespace ergodome
