#pragma once

#include <memory>
#include <vector>

namespace ergodome {

//! Captions on their own, to be laid over pictures of any resolution: the light of a display, linear, times coverage; four floats a pixel.
struct CaptionLayer {
  int width = 0;
  int height = 0;
  int first_row = 0;        //!< rows above it, and below the last, show nothing
  int row_count = 0;        //!< at least 1
  std::vector<float> rgba;  //!< of these rows, the top one first
};

//! A layer, and how much of it is seen: what fades as a whole is drawn once.
struct LaidCaptions {
  std::shared_ptr<const CaptionLayer> layer;  //!< none: nothing to see
  double opacity = 1.0;
};

}  // namespace ergodome
