#pragma once

#include "app/commands/render/frame_writer.h"

namespace ergodome {

//! Chooses the settings that --budget leaves open for rendering to files, prints them, and stores
//! them in the show and the options. Returns true. Without a budget, only returns true. Throws
//! UsageError for a malformed budget, and for --check without an error in the budget.
//!
//! With --check, stores nothing and returns false, because no frames are to be written. Measures
//! the error of the chosen settings at random times of the show, and throws Error if one exceeds
//! the budget.
bool use_render_budget(RenderOptions& options, Show& show, const std::optional<DomeSetup>& setup);

}  // namespace ergodome
