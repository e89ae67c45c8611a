#pragma once

namespace CLI {
class App;
}

namespace ergodome {

// Each function adds one command to the command line. The command runs when it is parsed, and
// throws Error if it fails.
void add_render_command(CLI::App& app);
void add_play_command(CLI::App& app);
void add_farm_command(CLI::App& app);
void add_node_command(CLI::App& app);
void add_trace_command(CLI::App& app);
void add_edge_command(CLI::App& app);
void add_connect_command(CLI::App& app);
void add_bake_command(CLI::App& app);
void add_inspect_command(CLI::App& app);
void add_catalogue_command(CLI::App& app);
void add_diagram_command(CLI::App& app);
void add_plan_command(CLI::App& app);
void add_accuracy_command(CLI::App& app);
void add_calibrate_command(CLI::App& app);
void add_convert_command(CLI::App& app);
void add_pad_command(CLI::App& app);

//! Runs the program and returns its exit status: 0, 2 for an invalid command line, 1 for other
//! errors. Prints errors on stderr.
int run_program(int argc, char** argv);

}  // namespace ergodome
