#pragma once

#include "app/commands/render/frame_request.h"
#include "app/commands/render/render_options.h"
#include "content/show/show.h"

namespace ergodome {

//! Writes the channels of frames [first, last], counted from 0, to an EXR or FITS file per frame.
//! With --resume, keeps complete frames that were written with the same options. Throws Error if a
//! file cannot be written or if the user interrupts.
void write_channel_frames(const RenderOptions& options, const Show& show, const FrameRequests& requests, int first,
                          int last);

}  // namespace ergodome
