#pragma once

#include <memory>
#include <vector>

namespace ergodome {

//! Captions on a transparent background, to be composited over pictures of any resolution: linear
//! display light times coverage; four floats per pixel.
struct CaptionLayer {
  int width = 0;
  int height = 0;
  //! Number of the first stored row; rows above it and below the last stored one are empty.
  int first_row = 0;
  int row_count = 0;        //!< number of stored rows, at least 1
  std::vector<float> rgba;  //!< pixels of the stored rows, top row first
};

//! A caption layer and the opacity with which it is shown. A layer of captions that all fade
//! together need not be drawn again.
struct LaidCaptions {
  std::shared_ptr<const CaptionLayer> layer;  //!< nullptr if there is nothing to see
  double opacity = 1.0;
};

}  // namespace ergodome
