#pragma once

#include <cstdint>

#include "kernels/image/lens_pixels.h"
#include "kernels/sky/cube_map.h"

namespace ergodome {

//! What a picture shows of the lens: the sky itself, or a heat map of one of its channels.
enum class ViewMode : std::int32_t { sky, steps, error_estimate, image_order, frequency_ratio, magnification };

//! Pixels to turn into light. Colour is linear and scene-referred, four floats a pixel (the fourth is the coverage).
struct ShadeBatch {
  LensPixels lens;
  CubeMap sky;
  ViewMode mode;
  bool beaming;     //!< the frequency ratio acts on the sky's light
  float exposure;   //!< factor on the sky's light
  float range_low;  //!< value at the low end of a heat map (its logarithm for logarithmic ones)
  float range_high;
  float* rgba;
  int count;
};

}  // namespace ergodome
