#pragma once

#include "app/commands/render/frame_writer.h"

namespace ergodome {

//! Chooses what --budget leaves open for frames that are written to files, puts it into the show and the options, and says so in a line. Nothing
//! happens where there is no budget. Throws Error for a budget that cannot be read.
//!
//! With --check the chosen settings are measured at random moments of the show; throws Error where one is beyond the budget. Whether frames are
//! to be written then: not where they were only checked.
bool use_render_budget(RenderOptions& options, Show& show, const std::optional<DomeSetup>& setup);

}  // namespace ergodome
