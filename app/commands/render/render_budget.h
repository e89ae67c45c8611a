#pragma once

#include "app/commands/render/frame_writer.h"

namespace ergodome {

//! Chooses the settings that --budget leaves open for rendering to files, stores them in the show
//! and the options, and prints them. Does nothing without a budget. Throws Error for a malformed
//! budget.
//!
//! With --check, measures the chosen settings at random times of the show, and throws Error if one
//! exceeds the budget. Returns false if only a check was requested, so that no frames are to be
//! written.
bool use_render_budget(RenderOptions& options, Show& show, const std::optional<DomeSetup>& setup);

}  // namespace ergodome
