#include <memory>

#include "app/backend_choice.h"
#include "app/commands.h"
#include "app/lens_options.h"
#include "app/player/player.h"
#include "app/player_keys.h"
#include "app/setup_show.h"
#include "app/show_loading.h"

namespace ergodome {

namespace {

struct PlayArguments {
  std::string show;
  std::string backend = "auto";
  std::string projection;
  std::string stereo;
  std::string setup;
  bool size_given = false;
  bool tint_eyes = false;
  LensOptions lens;
  PlayOptions options;
};

//! Makes the show what the setup's projectors need.
void play_on_projectors(PlayArguments& arguments, Show& show) {
  PlayOptions& options = arguments.options;
  options.setup = read_dome_setup(arguments.setup);
  options.projectors = projector_pictures(*options.setup);
  fit_to_setup(show, *options.setup);
  if (!arguments.size_given) {
    options.size_px = enough_master_px(options.projectors);
  }
}

void run(PlayArguments arguments) {
  arguments.options.free_flight = arguments.options.free_flight || arguments.show.empty();
  Show show = load_show(arguments.show.empty() ? "free-flight" : arguments.show);
  override_view(show, arguments.projection, arguments.stereo);
  if (has_face_files(show.view)) {
    // A window has them in one picture.
    show.view.cube_files = CubeFiles::cross;
  }
  show.stereo.tint_eyes = show.stereo.tint_eyes || arguments.tint_eyes;
  if (!arguments.setup.empty()) {
    play_on_projectors(arguments, show);
  }
  require_features(show);
  const Backend backend = choose_backend(arguments.backend);
  const LensOptions lens = arguments.lens;
  const auto make = [backend, lens](const Show& any) {
    return std::make_shared<ShowRenderer>(any, backend, lens_choice(lens), open_stream(any, lens, backend));
  };
  Player(show, make, arguments.options).run();
}

}  // namespace

void add_play_command(CLI::App& app) {
  auto arguments = std::make_shared<PlayArguments>();
  CLI::App* command = app.add_subcommand("play", "Play a show, or fly freely, in a window");
  command->footer(key_help());
  command->add_option("show", arguments->show,
                      "show file (.toml) or the name of a built-in show; without: free flight");
  command->add_option("--backend", arguments->backend, "auto, cpu or cuda")
      ->check(CLI::IsMember({"auto", "cpu", "cuda"}))
      ->capture_default_str();
  command
      ->add_option("--projection", arguments->projection,
                   "dome, equirect, cube, cylinder or pinhole, instead of the show's")
      ->check(CLI::IsMember(projection_names()));
  command->add_option("--stereo", arguments->stereo, "stereo layout, instead of the show's")
      ->check(CLI::IsMember(stereo_names()));
  command->add_flag("--tint-eyes", arguments->tint_eyes, "the left eye's picture reddish, the right one's cyan");
  add_lens_options(*command, arguments->lens);
  const CLI::Option* const size =
      command->add_option("--size", arguments->options.size_px, "width of one eye's image in pixels")
          ->check(CLI::Range(16, 8192))
          ->capture_default_str();
  command->add_option("--setup", arguments->setup, "dome setup (.toml): a window for each of its projectors, too");
  command->add_flag("--no-control", arguments->options.hide_control,
                    "with --setup: the projectors' windows alone; keys work in them");
  command->add_flag("--full-screen", arguments->options.full_screen, "fill the monitor");
  command->add_flag("--times", arguments->options.times_shown,
                    "show the frame time and the lens in the picture (key I)");
  command->add_flag("--fly", arguments->options.free_flight, "start in free flight");
  command
      ->add_option("--for", arguments->options.for_seconds, "end by itself this many seconds after the first picture")
      ->check(CLI::Range(0.0, 1e9));
  command->add_option("--screenshot", arguments->options.screenshot, "write what the window showed last to this PNG");
  command->callback([arguments, size] {
    arguments->size_given = size->count() > 0;
    run(*arguments);
  });
}

}  // namespace ergodome
