#pragma once

#include <filesystem>
#include <string>

#include "content/show.h"
#include "render/output/frame_format.h"

namespace ergodome {

//! Writes NAME.json and NAME.txt into the folder of a sequence: what a dome's staff must know to play the numbered frames that lie there
//! (rate, count, size, projection, stereo, colour), as a machine and as a person reads it. `size_px`: width of one eye's picture.
void write_sequence_facts(const std::filesystem::path& folder, const Show& show, const FrameFormat& format,
                          int size_px);

}  // namespace ergodome
