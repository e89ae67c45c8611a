#pragma once

#include <filesystem>
#include <string>

#include "content/show/show.h"
#include "render/output/frame_files.h"

namespace ergodome {

//! Frames of a show, counted from 0.
struct FrameSpan {
  int first = 0;
  int last = 0;
};

//! Writes NAME.json and NAME.txt into the folder of a sequence: what the staff of a dome must know
//! to play the existing numbered frames (rate, count, size, projection, stereo, color), for
//! programs and for people. For an animated number, the files contain its value in the first and
//! last of `frames`, and its range. The baseline is the one that was applied. `size_px` is the
//! width of one eye's picture.
void write_sequence_metadata(const std::filesystem::path& folder, const Show& show, const FrameFormat& format,
                             FrameSpan frames, int size_px);

}  // namespace ergodome
