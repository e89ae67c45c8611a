#include <unistd.h>

#include <CLI/CLI.hpp>
#include <array>
#include <charconv>
#include <memory>
#include <string>
#include <utility>

#include "app/cli/backend_choice.h"
#include "app/cli/commands.h"
#include "app/cli/lens_options.h"
#include "app/cli/option_checks.h"
#include "app/cli/setup_show.h"
#include "app/cli/show_loading.h"
#include "app/cli/show_options.h"
#include "app/cli/usage_error.h"
#include "app/exhibit/exhibit_scenes.h"
#include "app/exhibit/supervisor.h"
#include "app/player/cluster_gate.h"
#include "app/player/cluster_node_player.h"
#include "app/player/outputs/dome_output.h"
#include "app/player/outputs/headless_dome_output.h"
#include "app/player/renderers/play_renderers.h"
#include "content/files/console.h"
#include "content/files/whole_file.h"

namespace ergodome {

namespace {

struct NodeArguments {
  std::string show;
  bool exhibit = false;
  std::string attract;
  ShowSettings set;
  std::string setup;
  std::string master;
  std::string name;
  std::string new_key;
  std::string frame_log;
  std::string backend = "auto";
  bool without_windows = false;
  LensOptions lens;
};

std::string own_host_name() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

//! Sets host and port from HOST[:PORT]; without a port, that of the setup.
void set_master(NodeOptions& options, const std::string& master, int usual_port) {
  const std::size_t colon = master.rfind(':');
  options.host = master.substr(0, colon);
  options.port = usual_port;
  if (colon != std::string::npos) {
    constexpr int last_port = 65535;
    const char* const end = master.data() + master.size();
    const auto [read_to, error] = std::from_chars(master.data() + colon + 1, end, options.port);
    if (error != std::errc() || read_to != end || options.port < 1 || options.port > last_port) {
      throw UsageError("--master " + master, "is not HOST or HOST:PORT", "write a port from 1 to 65535");
    }
  }
  if (options.host.empty() || options.host.find_first_of("*/: ") != std::string::npos) {
    throw UsageError("--master " + master, "is not HOST or HOST:PORT", "give the master's name or IPv4 address");
  }
}

//! Reads shows: these files, or without any the show of the command line and, in an exhibit, the
//! attract show.
std::vector<Show> shows_of(const NodeArguments& arguments, const DomeSetup& setup,
                           const std::vector<std::filesystem::path>& files) {
  const auto fitted = [&](const std::string& name) {
    Show show = load_show(name, files.empty() ? arguments.set : ShowSettings());
    fit_to_setup(show, setup);
    require_features(show);
    return show;
  };
  std::vector<Show> shows;
  shows.reserve(files.size());
  for (const std::filesystem::path& file : files) {
    shows.push_back(fitted(file.string()));
  }
  if (!files.empty() || (arguments.show.empty() && !arguments.exhibit)) {
    return shows;
  }
  shows = {fitted(arguments.show.empty() ? usual_visitor_show : arguments.show)};
  if (arguments.exhibit) {
    shows.push_back(fitted(arguments.attract.empty() ? usual_attract_show(shows.front()) : arguments.attract));
  }
  return shows;
}

void make_key_file(const std::string& file) {
  ClusterKeys keys;
  std::string problem;
  if (!cluster_library().make_keys(keys, problem)) {
    throw Error("--make-key " + file, "cannot make keys: " + problem, "use a libzmq5 with CURVE");
  }
  write_cluster_keys(file, keys);
  print_out("wrote {}; copy it to the folder of the setup on every computer\n", file);
}

void run_node(const NodeArguments& arguments) {
  if (!arguments.new_key.empty()) {
    make_key_file(arguments.new_key);
    return;
  }
  if (arguments.setup.empty() || arguments.master.empty()) {
    throw UsageError("node", "needs --setup and --master", "run ergodome node SHOW --setup dome.toml --master HOST");
  }
  NodeOptions options;
  options.name = arguments.name.empty() ? own_host_name() : arguments.name;
  options.frame_log = arguments.frame_log;
  ProjectorOptions projectors;
  projectors.setup = read_dome_setup(arguments.setup);
  const DomeSetup whole = projectors.setup;
  options.keys = read_cluster_keys(cluster_key_file(whole, "--setup"));
  options.identity = cluster_identity(whole);
  set_master(options, arguments.master, whole.cluster->port);
  projectors.pictures = projector_pictures(whole);
  projectors.master_px = enough_master_px(projectors.pictures);
  projectors.hide_control = true;
  keep_projectors_of(projectors, options.name);
  if (projectors.pictures.empty()) {
    throw UsageError("--name " + options.name, "is not the node of any projector in " + arguments.setup,
                     "write node = \"" + options.name + "\" for the projectors of this computer, or give --name");
  }
  options.setup = whole;
  options.load = [arguments, whole](const std::vector<std::filesystem::path>& files) {
    return shows_of(arguments, whole, files);
  };
  const Backend backend = choose_backend(arguments.without_windows ? "cpu" : arguments.backend);
  std::unique_ptr<DisplayOutput> output;
  if (arguments.without_windows) {
    auto headless = std::make_unique<HeadlessDomeOutput>(projectors.pictures);
    options.images = [shown = headless.get()] { return shown->images(); };
    output = std::move(headless);
  } else {
    WindowOptions window;
    output = std::make_unique<DomeOutput>(window, projectors);
  }
  const RendererLoader::Make make = renderer_maker({backend,
                                                    arguments.backend == "auto",
                                                    arguments.lens,
                                                    projectors.master_px,
                                                    false,
                                                    std::make_shared<NoteBoard>(),
                                                    {}});
  ClusterNodePlayer player(options, make, std::move(output));
  player.run();
  stop_reading();
}

}  // namespace

void add_node_command(CLI::App& app) {
  auto arguments = std::make_shared<NodeArguments>();
  CLI::App* command = app.add_subcommand("node", "Show a part of a dome together with other computers");
  command->add_option("show", arguments->show, "the show that the master plays (default: from its --push-content)");
  add_set_option(*command, arguments->set);
  command->add_option("--master", arguments->master, "computer that runs play --cluster")->type_name("HOST[:PORT]");
  command->add_option("--setup", arguments->setup, "dome setup (.toml), the same as the master's")->type_name("FILE");
  command->add_option("--name", arguments->name, "name of this computer in the setup (default: its host name)")
      ->type_name("NAME");
  command->add_option("--make-key", arguments->new_key, "write new keys of a cluster to this file, and quit")
      ->type_name("FILE");
  CLI::Option* const exhibit =
      command->add_flag("--exhibit", arguments->exhibit,
                        "with play --exhibit on the master: also show the attract show; restart after crashes");
  command->add_option("--attract", arguments->attract, "with --exhibit: the attract show, as on the master")
      ->type_name("SHOW")
      ->needs(exhibit);
  command->add_option("--frame-log", arguments->frame_log, "list the shown frames in this CSV file")->type_name("FILE");
  command->add_flag("--no-windows", arguments->without_windows,
                    "render on the CPU without opening windows, to test the network");
  IgnoredOptions ignored(*command);
  add_backend_option(*command, arguments->backend);
  add_lens_options(*command, arguments->lens, ignored);
  command->callback([arguments, ignored] {
    ignored.refuse();
    if (arguments->exhibit) {
      restart_after_crashes();
    }
    run_node(*arguments);
  });
}

}  // namespace ergodome
