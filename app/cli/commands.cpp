#include "app/cli/commands.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "app/cli/backend_choice.h"
#include "app/cli/help_format.h"
#include "app/cli/interrupt.h"
#include "app/cli/usage_error.h"
#include "content/files/console.h"
#include "content/files/toml_table.h"
#include "kernels/core/error.h"
#include "render/backend/cached_memory.h"

namespace ergodome {

namespace {

//! Reports an unknown command, and returns the exit status.
int refuse_word(const CLI::App& app, const std::string& word) {
  std::vector<std::string> commands;
  for (const CLI::App* command : app.get_subcommands({})) {
    commands.push_back(command->get_name());
  }
  const std::string nearest = nearest_word(word, commands);
  const std::string remedy = nearest.empty() ? "try --help" : "did you mean " + nearest + "?";
  print_note("unknown command {}; {}", word, remedy);
  return 2;
}

//! Returns the parser's message, rewritten if an option was given twice.
std::string parser_message(const CLI::Error& problem) {
  constexpr std::string_view too_often = ": At Most 1 required but received ";
  const std::string said = problem.what();
  const std::size_t at = said.find(too_often);
  if (at == std::string::npos) {
    return "ergodome: " + said + "; try --help\n";
  }
  return "ergodome: " + said.substr(0, at) + ": was given " + said.substr(at + too_often.size()) +
         " times; give it once\n";
}

int run_commands(int argc, char** argv) {
  keep_freed_memory();
  CLI::App app("Ergodome shows what a spinning black hole does to the sky around it.", "ergodome");
  app.set_version_flag("--version", "ergodome " ERGODOME_VERSION);
  app.require_subcommand(1);
  app.formatter(std::make_shared<HelpFormat>());
  app.failure_message([](const CLI::App*, const CLI::Error& problem) { return parser_message(problem); });
  add_play_command(app);
  add_node_command(app);
  add_render_command(app);
  add_farm_command(app);
  add_bake_command(app);
  add_inspect_command(app);
  add_plan_command(app);
  add_diagram_command(app);
  add_accuracy_command(app);
  add_catalogue_command(app);
  add_calibrate_command(app);
  add_convert_command(app);
  add_pad_command(app);
  add_trace_command(app);
  add_edge_command(app);
  add_connect_command(app);
  group_commands(app);
  app.footer("ergodome COMMAND --help lists the options of a command. The documentation describes them in full.");
  catch_interrupts();
  fail_at_file_limits();
  try {
    check_environment();
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    const std::vector<std::string> words = app.remaining();
    const auto word = std::ranges::find_if(words, [](const std::string& each) { return !each.starts_with("-"); });
    if (problem.get_exit_code() != 0 && app.get_subcommands().empty() && word != words.end()) {
      return refuse_word(app, *word);
    }
    return app.exit(problem) == 0 ? 0 : 2;
  } catch (const UsageError& problem) {
    print_note("{}", problem.what());
    return 2;
  } catch (const std::bad_alloc&) {
    print_note("not enough memory; choose a smaller size");
    return 1;
  } catch (const std::exception& problem) {
    print_note("{}", problem.what());
    return 1;
  }
  return 0;
}

}  // namespace

int run_program(int argc, char** argv) {
  prepare_console();
  const int status = run_commands(argc, argv);
  return finish_output() || status != 0 ? status : 1;
}

}  // namespace ergodome
