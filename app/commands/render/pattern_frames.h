#pragma once

#include <string>

#include "content/show/show.h"
#include "render/output/image_writer.h"

namespace ergodome {

//! Test patterns for a show's view and stereo layout, as files.
struct PatternFrames {
  std::string pattern;  //!< its name, or "all"
  std::string out;      //!< folder
  FrameFormat format;
  int size_px = 0;  //!< width of one eye's picture; 0: as the show says
};

//! Writes NAME.png for each pattern, both eyes as the show's stereo layout has them. Returns how many files.
int write_pattern_frames(const PatternFrames& frames, const Show& show);

}  // namespace ergodome
