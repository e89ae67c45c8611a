#pragma once

#include <string>

#include "content/show/show.h"
#include "render/output/image_writer.h"

namespace ergodome {

//! Options for writing test patterns as files for a show's view and stereo layout.
struct PatternFrames {
  std::string pattern;  //!< name of a pattern, or "all"
  std::string out;      //!< folder
  FrameFormat format;
  int size_px = 0;  //!< width of one eye's picture; 0: the show's
};

//! Writes a file for each pattern, named after it, in the format of `frames`. Eyes are arranged as
//! in the show's stereo layout; those of `separate` are in the folders L and R. Returns the number
//! of files.
int write_pattern_frames(const PatternFrames& frames, const Show& show);

}  // namespace ergodome
