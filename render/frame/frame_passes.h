#pragma once

#include <span>

#include "render/plan/frame_plan.h"
#include "render/plan/pass_kind.h"

namespace ergodome {

//! Returns the kinds of all passes, in the order in which they draw. A new pass is registered here.
std::span<const PassKind> frame_passes();

//! Plans the pictures that ShowRenderer::render() makes: asks each pass, in drawing order, which
//! work it does. For a show with animated numbers, the plan contains the work that is done when all
//! are at their maximum; work that is not done when all are at their minimum is marked `if_needed`.
FramePlan plan_frame(const Show& show, const FrameRequest& request);

}  // namespace ergodome
