#pragma once

#include "app/commands/render/frame_writer.h"

namespace ergodome {

//! Throws UsageError if --meter or --light is given and the exposure of the frames is not automatic.
void require_metering(const RenderOptions& options, const Show& show);

//! Measures the light of frames [first, last] and writes it to the folder of --meter. Throws Error
//! if interrupted.
void meter_frames(const RenderOptions& options, FrameWriter& writer, int first, int last);

}  // namespace ergodome
