#pragma once

#include <memory>
#include <vector>

namespace ergodome {

//! Captions without a picture, to be composited over pictures of any resolution: linear display
//! light times coverage; four floats per pixel.
struct CaptionLayer {
  int width = 0;
  int height = 0;
  int first_row = 0;        //!< rows above it and below the last are empty
  int row_count = 0;        //!< at least 1
  std::vector<float> rgba;  //!< of these rows, top row first
};

//! A layer and its opacity. Captions that fade together are drawn only once.
struct LaidCaptions {
  std::shared_ptr<const CaptionLayer> layer;  //!< nullptr if there is nothing to see
  double opacity = 1.0;
};

}  // namespace ergodome
