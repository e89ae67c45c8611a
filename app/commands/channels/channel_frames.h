#pragma once

#include "app/commands/render/frame_request.h"
#include "app/commands/render/render_options.h"
#include "content/show/show.h"

namespace ergodome {

//! Writes the numbers of frames [first, last], counted from 0, to files: an EXR or a FITS file a frame. With --resume only those that are not there,
//! complete, and asked for alike. Throws Error where one cannot be written, and where a person stops it.
void write_channel_frames(const RenderOptions& options, const Show& show, const FrameRequests& requests, int first,
                          int last);

}  // namespace ergodome
