#pragma once

#include "render/output/tone.h"

namespace ergodome {

//! A picture in GPU memory: four floats per pixel.
struct DevicePicture {
  const float* rgba = nullptr;   //!< the picture or the left eye's
  const float* right = nullptr;  //!< the right eye's, of the same size, if both are shown whole
  bool above = false;            //!< the left eye is above the right one, not beside it
  int width_px = 0;              //!< of one eye's picture
  int height_px = 0;
  bool heat_map = false;
  Tone tone;
};

}  // namespace ergodome
