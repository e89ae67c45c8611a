#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/interrupt.h"
#include "app/usage_error.h"
#include "content/files/toml_table.h"
#include "kernels/core/error.h"
#include "render/backend/kept_memory.h"

namespace {

//! A word that is no command.
int refuse_word(const CLI::App& app, const std::string& word) {
  std::vector<std::string> commands;
  for (const CLI::App* command : app.get_subcommands({})) {
    commands.push_back(command->get_name());
  }
  const std::string nearest = ergodome::nearest_word(word, commands);
  const std::string remedy = nearest.empty() ? "try --help" : "did you mean " + nearest + "?";
  std::fprintf(stderr, "ergodome: there is no command %s; %s\n", word.c_str(), remedy.c_str());
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  ergodome::keep_freed_memory();
  CLI::App app("Ergodome shows what a spinning black hole does to the sky around it.", "ergodome");
  app.set_version_flag("--version", "ergodome " ERGODOME_VERSION);
  app.require_subcommand(1);
  app.failure_message([](const CLI::App*, const CLI::Error& problem) {
    return std::string("ergodome: ") + problem.what() + "; try --help\n";
  });
  ergodome::add_play_command(app);
  ergodome::add_render_command(app);
  ergodome::add_bake_command(app);
  ergodome::add_inspect_command(app);
  ergodome::add_plan_command(app);
  ergodome::add_diagram_command(app);
  ergodome::add_accuracy_command(app);
  ergodome::add_catalogue_command(app);
  ergodome::add_calibrate_command(app);
  ergodome::add_convert_command(app);
  ergodome::add_pad_command(app);
  ergodome::add_trace_command(app);
  ergodome::add_edge_command(app);
  ergodome::add_connect_command(app);
  ergodome::catch_interrupts();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    const std::vector<std::string> words = app.remaining();
    const auto word = std::ranges::find_if(words, [](const std::string& each) { return !each.starts_with("-"); });
    if (problem.get_exit_code() != 0 && app.get_subcommands().empty() && word != words.end()) {
      return refuse_word(app, *word);
    }
    return app.exit(problem) == 0 ? 0 : 2;
  } catch (const ergodome::UsageError& problem) {
    std::fprintf(stderr, "ergodome: %s\n", problem.what());
    return 2;
  } catch (const std::bad_alloc&) {
    std::fputs("ergodome: not enough memory; choose a smaller size\n", stderr);
    return 1;
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "ergodome: %s\n", problem.what());
    return 1;
  }
  return 0;
}
