#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <memory>
#include <optional>
#include <sstream>
#include <utility>

#include "app/budget/budget_option.h"
#include "app/budget/play_plan.h"
#include "app/cli/backend_choice.h"
#include "app/cli/commands.h"
#include "app/cli/lens_options.h"
#include "app/cli/number_check.h"
#include "app/cli/output_file.h"
#include "app/cli/setup_show.h"
#include "app/cli/show_loading.h"
#include "app/cli/usage_error.h"
#include "app/exhibit/kept_settings.h"
#include "app/exhibit/log_file.h"
#include "app/exhibit/restarts.h"
#include "app/playback/midi_time_code.h"
#include "app/player/player.h"
#include "app/player/recording/numbered_records.h"
#include "app/player/renderers/play_renderers.h"
#include "content/files/console.h"
#include "content/show/animatable_number.h"
#include "render/output/stereo_layout.h"

namespace ergodome {

namespace {

struct PlayArguments {
  std::string show;
  ShowSettings set;
  std::string backend = "auto";
  std::string projection;
  std::string objects;
  std::string stereo;
  std::string setup;
  bool size_given = false;
  std::optional<double> tilt_deg;
  std::optional<double> baseline;
  bool tint_eyes = false;
  bool exhibit = false;
  ExhibitOptions exhibit_options;
  std::string new_controls;
  LensOptions lens;
  std::vector<std::string> budget;
  PlayOptions options;
};

//! The keys, a line each, for --help.
std::string key_help() {
  std::string text = "Keys:\n";
  std::istringstream lines(Controls().help_text({.pads = false}));
  for (std::string line; std::getline(lines, line);) {
    text += fmt::format("  {}\n", line);
  }
  text.pop_back();
  return text;
}

//! Reads the setup whose projectors are to show the pictures.
void use_setup(PlayArguments& arguments) {
  PlayOptions& options = arguments.options;
  options.setup = read_dome_setup(arguments.setup);
  options.projectors = projector_pictures(*options.setup);
  options.projectors_px = enough_master_px(options.projectors);
  if (!arguments.size_given) {
    options.size_px = options.projectors_px;
  }
}

//! A show as the command line wants it.
Show loaded_show(const PlayArguments& arguments, const std::string& name) {
  Show show = load_show(name, arguments.set);
  override_view(show, arguments.projection, arguments.stereo);
  override_baseline(show, arguments.baseline);
  override_tilt(show, arguments.tilt_deg, arguments.options.setup.has_value());
  override_objects(show, arguments.objects);
  if (has_face_files(show.view)) {
    // A window has them in one picture.
    show.view.cube_files = CubeFiles::cross;
  }
  show.stereo.tint_eyes = show.stereo.tint_eyes || arguments.tint_eyes;
  if (arguments.options.setup) {
    fit_to_setup(show, *arguments.options.setup, arguments.stereo);
  }
  require_features(show);
  return show;
}

//! Of an exhibit's records the oldest go: a show that has the name of one would go with them. Throws UsageError.
void require_no_record(const std::string& record, const std::string& show) {
  std::error_code problem;
  const auto folder = [](const std::filesystem::path& file) {
    return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  };
  if (!record.empty() && record_number(record, show) &&
      std::filesystem::equivalent(folder(record), folder(show), problem)) {
    throw UsageError("--record " + record,
                     show + " has the name of one of its records, of which the oldest are removed",
                     "give the show that is to stay another name");
  }
}

std::filesystem::path exhibit_log() {
  const std::filesystem::path folder = state_folder();
  return folder.empty() ? folder : folder / "ergodome.log";
}

//! An exhibit keeps its settings and its log, and says nothing on the terminal that nobody sees.
void use_exhibit(PlayArguments& arguments, const Show& visitor) {
  PlayOptions& options = arguments.options;
  if (arguments.exhibit_options.attract.empty()) {
    arguments.exhibit_options.attract = usual_attract_show(visitor);
  }
  arguments.exhibit_options.state = state_folder();
  options.services.log_file = exhibit_log();
  if (arguments.exhibit_options.state.empty()) {
    print_note("settings and the log are not kept, as this user has no home folder; set HOME or XDG_STATE_HOME");
  }
  options.exhibit = arguments.exhibit_options;
}

//! Measures the show, chooses what the budget leaves open, and says so. The renderer that this was done with, for the show to begin with; none
//! without a budget.
std::shared_ptr<ShowRenderer> use_budget(PlayArguments& arguments, const Show& show, const RendererLoader::Make& make) {
  const Budget budget = parse_budget(arguments.budget);
  if (budget.empty()) {
    return nullptr;
  }
  PlayOptions& options = arguments.options;
  std::shared_ptr<ShowRenderer> renderer = make(show);
  const ToldPlan told = plan_play(*renderer, show,
                                  {budget, options.size_px, arguments.size_given, lens_choice(arguments.lens),
                                   options.free_flight || arguments.exhibit});
  print_out("{}\n", told.line);
  std::fflush(stdout);
  options.budget = told.plan;
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
    throw UsageError("--record " + options.record, "is no name of a show", "let it end in .toml");
  }
  require_output_file("--record", options.record, {arguments.show, arguments.setup, options.controls});
  options.free_flight = options.free_flight || arguments.show.empty();
  if (const std::filesystem::path state = state_folder(); !state.empty()) {
    options.services.remote.kept_token_file = state / "web-token";
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
  tell_equal_eyes(show);
  if (keeps_eyes_apart(show.stereo.layout) && !options.setup) {
    print_note("the window shows the eyes of layout {} side by side; render writes them apart",
               stereo_layout_names[static_cast<std::size_t>(show.stereo.layout)]);
  }
  const Backend backend = choose_backend(arguments.backend);
  // Of a budget's pictures its own line tells.
  const RendererLoader::Make make =
      renderer_maker({backend, arguments.backend == "auto", arguments.lens, options.size_px, arguments.budget.empty(),
                      options.notes, arguments.options.language});
  std::shared_ptr<ShowRenderer> first = use_budget(arguments, show, make);
  Player(show, with_first(make, show.name, std::move(first)), options).run();
}

//! The same; an exhibit comes back after crashes, and its log says why it does not begin.
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

//! Throws UsageError where the show's time comes by OSC, and nothing listens to it.
void require_osc_port(const ServiceOptions& services) {
  if (services.clock == "osc" && !services.remote.osc_port) {
    throw UsageError("--clock osc", "has no port to listen at", "add --osc PORT");
  }
}

}  // namespace

void add_play_command(CLI::App& app) {
  auto arguments = std::make_shared<PlayArguments>();
  CLI::App* command = app.add_subcommand("play", "Play a show, or fly freely, in a window");
  command->footer(key_help());
  command->add_option("show", arguments->show,
                      "show file (.toml) or the name of a built-in show; without: free flight");
  add_set_option(*command, arguments->set);
  command->add_option("--backend", arguments->backend, "auto, cpu or cuda")
      ->check(CLI::IsMember({"auto", "cpu", "cuda"}))
      ->capture_default_str();
  command->add_option("--objects", arguments->objects, "how objects are drawn: polygon or trace; else as the show says")
      ->check(CLI::IsMember(object_method_names()));
  command
      ->add_option("--projection", arguments->projection,
                   "dome, equirect, cube, cylinder or pinhole, instead of the show's")
      ->check(CLI::IsMember(projection_names()));
  command->add_option("--stereo", arguments->stereo, "stereo layout, instead of the show's")
      ->check(CLI::IsMember(stereo_names()));
  command
      ->add_option("--tilt", arguments->tilt_deg,
                   "tilt of the dome's picture [deg], instead of the show's and the setup's")
      ->check(number_between(limits_of("view.tilt_deg").least, limits_of("view.tilt_deg").greatest));
  command->add_option("--baseline", arguments->baseline, "distance of the eyes [M], instead of the show's")
      ->check(number_between(limits_of("stereo.baseline").least, limits_of("stereo.baseline").greatest));
  command->add_flag("--tint-eyes", arguments->tint_eyes, "the left eye's picture reddish, the right one's cyan");
  IdleOptions idle(*command);
  add_lens_options(*command, arguments->lens, idle);
  const CLI::Option* const size =
      command->add_option("--size", arguments->options.size_px, "width of one eye's image in pixels")
          ->check(CLI::Range(16, 8192))
          ->capture_default_str();
  add_budget_option(*command, arguments->budget);
  CLI::Option* const setup =
      command->add_option("--setup", arguments->setup, "dome setup (.toml): a window for each of its projectors, too");
  command
      ->add_flag("--no-control", arguments->options.hide_control,
                 "with --setup: the projectors' windows alone; keys work in them")
      ->needs(setup);
  command->add_flag("--full-screen", arguments->options.full_screen, "fill the monitor");
  command->add_flag("--times", arguments->options.times_shown,
                    "show the frame time, the lens, the spin and the camera position in the picture (key I)");
  command->add_flag("--quiet", arguments->options.quiet,
                    "nothing is said in the picture but what keys ask for (F1, I); the log and the status page say it");
  command->add_flag("--fly", arguments->options.free_flight, "start in free flight");
  command
      ->add_option("--for", arguments->options.for_seconds, "end by itself this many seconds after the first picture")
      ->check(number_between(0.0, 1e9));
  command->add_option("--language", arguments->options.language, "of captions and narration, by its tag (en, de)");
  command->add_option("--record", arguments->options.record, "write the flight to this show file (.toml)");
  command->add_option("--controls", arguments->options.controls, "a map of keys, mouse and pads (.toml)");
  command->add_option("--write-controls", arguments->new_controls, "write the map of controls to this file, and end");
  command->add_option("--pad-settings", arguments->options.pad_settings, "settings of pads, made by ergodome pad");
  command->add_option("--pad-fixture", arguments->options.pad_fixture,
                      "play recorded pads in place of those that are plugged in");
  command
      ->add_option("--clock", arguments->options.services.clock,
                   "what the show's time follows: own, mtc (MIDI time code), mtc:PORT, osc")
      ->check([](const std::string& word) {
        const bool known = word == "own" || word == "osc" || word == "mtc" || word.rfind("mtc:", 0) == 0;
        return known ? std::string() : "is none of own, mtc, mtc:PORT, osc";
      })
      ->capture_default_str();
  command
      ->add_option("--clock-start", arguments->options.services.clock_start,
                   "with --clock mtc: the time code at which the show begins")
      ->check([](const std::string& text) {
        const bool known = parse_time_code(text, CodeRate::fps30).has_value();
        return known ? std::string()
                     : text + " is no time code; write hours, minutes, seconds and frames, as in 01:00:00:00";
      })
      ->capture_default_str();
  CLI::Option* const no_sound = command->add_flag("!--no-sound", arguments->options.services.sound, "play no sound");
  command
      ->add_option("--sound-later", arguments->options.services.sound_later_s,
                   "seconds by which sound is heard later, for displays that take their time")
      ->check(number_between(-1.0, 1.0))
      ->excludes(no_sound);
  add_remote_options(*command, arguments->options.services.remote);
  CLI::Option* const locked =
      command->add_flag("--exhibit", arguments->exhibit,
                        "full screen, locked: an attract show until somebody touches something, then free flight");
  ExhibitOptions& exhibit = arguments->exhibit_options;
  command
      ->add_option("--attract", exhibit.attract,
                   "with --exhibit: the show that runs by itself; without: attract, or on domes once-around")
      ->needs(locked);
  command->add_option("--idle", exhibit.times.idle_s, "with --exhibit: seconds without a touch that end a flight")
      ->check(number_between(1.0, 86400.0))
      ->needs(locked)
      ->capture_default_str();
  command
      ->add_option("--session", exhibit.times.session_s,
                   "with --exhibit: seconds after which a flight ends; 0: no limit")
      ->check(number_between(0.0, 86400.0))
      ->needs(locked)
      ->capture_default_str();
  command->add_option("--screenshot", arguments->options.screenshot, "write what the window showed last to this PNG");
  idle.add("without --clock mtc", [arguments] { return !arguments->options.services.clock.starts_with("mtc"); },
           {"--clock-start"});
  idle.add("with --exhibit, which flies when a visitor comes", [arguments] { return arguments->exhibit; }, {"--fly"});
  idle.add("of projectors' pictures, whose domemasters the setup tells",
           [arguments] { return !arguments->setup.empty() && arguments->projection != "dome"; }, {"--projection"});
  command->callback([arguments, size, idle] {
    idle.refuse();
    require_osc_port(arguments->options.services);
    arguments->size_given = size->count() > 0;
    run_logged(*arguments);
  });
}

}  // namespace ergodome
