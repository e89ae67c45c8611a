#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "render/frame/show_renderer.h"
#include "render/output/frame_files.h"

namespace ergodome {

//! Time and size of one frame with all its files.
struct RunFrameCost {
  double seconds = 0.0;
  std::uintmax_t bytes = 0;
};

//! If the first frame of a run takes at least this time [s], the cost of a run is estimated from
//! it, otherwise from the next: the first frame also prepares data that all frames share.
inline constexpr double slow_frame_s = 2.0;

//! Describes the time and disk space of a run: "1,800 frames, about 1 s each: 30 min, 1.1 GB".
std::string run_cost_text(long frames, const RunFrameCost& frame);

//! Returns a warning if `needed_bytes` do not fit on the disk of `folder`, which has `left_bytes`
//! free; otherwise an empty text. `what` names what needs the space: "the rest of the run".
std::string room_note(const std::string& folder, const std::string& what, std::uintmax_t needed_bytes,
                      std::uintmax_t left_bytes);

//! Returns the free bytes on the disk of a folder, or of its nearest parent that exists. Throws
//! std::filesystem::filesystem_error.
std::uintmax_t free_bytes(const std::filesystem::path& folder);

//! Returns the assumed minimum ratio of compressed to uncompressed size of a frame: 1 for
//! uncompressed EXR, otherwise 0.1.
double min_compressed_part(const FrameFormat& format);

//! Returns the uncompressed size of pictures with this total number of pixels [bytes].
std::uintmax_t uncompressed_bytes(const FrameFormat& format, std::uintmax_t pixels);

//! A frame and its cost.
struct MeasuredFrame {
  int frame = 0;  //!< number of the measured frame, from 0
  RunFrameCost cost;
};

//! Measures a frame, counted from 0: renders it, writes its files into a temporary folder, and
//! removes them. Before it, measures the previous frame, if there is one, because the first frame
//! rendered also prepares data that all frames share; if the previous frame takes at least
//! `slow_s`, returns its cost instead. Throws Error if files cannot be written.
MeasuredFrame measured_frame(ShowRenderer& renderer, const ViewChoice& choice, const FrameFormat& format, int frame,
                             double slow_s = slow_frame_s);

}  // namespace ergodome
