#pragma once

#include <span>

#include "render/plan/frame_plan.h"
#include "render/plan/pass_kind.h"

namespace ergodome {

//! Returns all passes in the order in which they draw. A new pass is registered here.
std::span<const PassKind> frame_passes();

//! Plans the pictures that ShowRenderer::render makes: asks each pass, in order, what it does. For
//! a show with animated numbers, the plan holds all work at their maximum; work that their minimum
//! does not need is marked `if_needed`.
FramePlan plan_frame(const Show& show, const FrameRequest& request);

}  // namespace ergodome
