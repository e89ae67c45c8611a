#pragma once

#include <memory>

#include "app/cli/option_checks.h"
#include "app/commands/render/render_options.h"
#include "content/show/show.h"

namespace ergodome {

//! Adds --format to `render`: image formats, and FITS for channels. `options` must outlive the
//! command.
CLI::Option* add_format_option(CLI::App& command, RenderOptions& options);

//! Adds --channels to `render`. `options` must outlive the command.
void add_channel_option(CLI::App& command, RenderOptions& options);

//! Registers the options that have no effect with --channels.
void add_channel_rules(const std::shared_ptr<RenderOptions>& options, IgnoredOptions& ignored);

//! Sets the format to EXR if channels are to be written and no format is given. Throws UsageError
//! if images are to be written as FITS.
void choose_number_format(RenderOptions& options, bool format_is_given);

//! Throws UsageError if --channels is incompatible with other options or with the show.
void require_channels(const RenderOptions& options, const Show& show);

}  // namespace ergodome
