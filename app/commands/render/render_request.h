#pragma once

#include <optional>
#include <utility>

#include "app/commands/render/render_options.h"
#include "calibration/dome/dome_setup.h"
#include "content/show/show.h"

namespace ergodome {

//! Loads the show and applies the options of the command line. Patterns without a show use a dome
//! of 180°.
Show chosen_show(const RenderOptions& options);

//! Returns the dome setup if frames for its projectors are requested.
std::optional<DomeSetup> chosen_setup(const RenderOptions& options);

//! Fits a show to the setup, if there is one, and prints a note if that changes the show's tilt.
void fit_to_chosen_setup(const RenderOptions& options, const std::optional<DomeSetup>& setup, Show& show);

//! Throws UsageError if files of the chosen format cannot hold the show's stereo layout.
void require_file_layout(const RenderOptions& options, const Show& show);

//! Throws UsageError if an option has no effect on this show, or if --view-range is malformed.
void require_used_options(const RenderOptions& options, const Show& show);

//! Checks what all frames and the film of a run need, prints notes about what they lose, and
//! chooses the language of the title. Throws Error if the show cannot be rendered so.
void prepare_frames(const RenderOptions& options, Show& show);

//! Returns whether the exposure of the files' frames is automatic, so that it depends on the frames
//! before. EXR files are linear, and heat maps have a color scale of their own.
bool follows_exposure(const RenderOptions& options, const Show& show);

//! Returns whether the frames of a show depend on --language.
bool frames_show_language(const Show& show);

//! Returns the first and last chosen frame, counted from 0.
std::pair<int, int> chosen_frames(const RenderOptions& options, const Show& show);

}  // namespace ergodome
