#pragma once

#include <vector>

#include "app/commands/render/frame_files.h"

namespace ergodome {

//! Returns the frames of [first, last] that FrameFiles::is_there() rejects. Throws Error if
//! interrupted.
std::vector<int> lacking_frames(const FrameFiles& files, int first, int last);

}  // namespace ergodome
