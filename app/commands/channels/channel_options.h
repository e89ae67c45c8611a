#pragma once

#include <memory>

#include "app/cli/idle_options.h"
#include "app/commands/render/render_options.h"
#include "content/show/show.h"

namespace ergodome {

//! Adds --format to `render`: pictures' formats, and FITS for numbers. `options` outlives the command.
CLI::Option* add_format_option(CLI::App& command, RenderOptions& options);

//! Adds --channels to `render`. `options` outlives the command.
void add_channel_option(CLI::App& command, RenderOptions& options);

//! Names the options that change nothing beside --channels.
void add_channel_rules(const std::shared_ptr<RenderOptions>& options, IdleOptions& idle);

//! Chooses the format of numbers where none is given. Throws UsageError where pictures are to be written as FITS.
void choose_number_format(RenderOptions& options, bool format_is_given);

//! Throws UsageError where the numbers of --channels cannot be written as the options ask, or of such a show.
void require_channels(const RenderOptions& options, const Show& show);

}  // namespace ergodome
