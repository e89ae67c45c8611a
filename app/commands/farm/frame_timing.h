#pragma once

#include "app/commands/farm/farm_plan.h"
#include "app/commands/render/render_options.h"
#include "content/show/show.h"

namespace ergodome {

//! Measured times of a film on this machine.
struct FrameTiming {
  double frame_s = 0.0;  //!< mean time of the measured frames
  double start_s = 0.0;  //!< time to prepare the first frame
};

//! Renders a few frames of a film, at three times of it, and measures them. Stops early if that takes
//! longer than a minute.
FrameTiming time_frames(const RenderOptions& options, const Show& show, const FrameChunk& film);

}  // namespace ergodome
