#pragma once

#include <filesystem>
#include <string>

#include "content/show/show.h"
#include "render/output/frame_format.h"

namespace ergodome {

//! Frames of a show, counted from 0.
struct FrameSpan {
  int first = 0;
  int last = 0;
};

//! Writes NAME.json and NAME.txt into the folder of a sequence: what a dome's staff must know to play the numbered frames that lie there
//! (rate, count, size, projection, stereo, colour), as a machine and as a person reads it. Of numbers that change it says what they are in the first and in the last of `frames`, and
//! the bounds of what they are in all; the distance of the eyes is the one that fitted. `size_px`: width of one eye's picture.
void write_sequence_facts(const std::filesystem::path& folder, const Show& show, const FrameFormat& format,
                          FrameSpan frames, int size_px);

}  // namespace ergodome
