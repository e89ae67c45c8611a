#pragma once

#include "app/cli/option_checks.h"
#include "app/commands/render/render_options.h"

namespace ergodome {

// Options that `render` shares with commands that render in several processes.

//! Adds the options that choose frames, pictures and files: all that the content of a frame depends
//! on, and --movie. Registers where they have no effect. `options` must outlive the command. Returns
//! the option of the files' format.
CLI::Option* add_film_options(CLI::App& command, RenderOptions& options, IgnoredOptions& ignored);

}  // namespace ergodome
