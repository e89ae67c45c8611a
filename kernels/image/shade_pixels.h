#pragma once

#include <cstdint>

#include "kernels/image/lens_pixels.h"
#include "kernels/projection/projection.h"
#include "kernels/sky/blackbody.h"
#include "kernels/sky/cube_map.h"
#include "kernels/sky/sky_look.h"

// Batches of pixels to shade.
namespace ergodome {

//! Content of a picture: the sky itself, or a heat map of one channel of the lens.
enum class ViewMode : std::int32_t { sky, steps, error_estimate, image_order, frequency_ratio, magnification };

//! Pixels to convert to light. Color is linear and scene-referred, four floats per pixel (the
//! fourth is the coverage).
struct ShadeBatch {
  LensPixels lens;
  CubeMap sky;  //!< unused by SkyFilter::polygon
  ViewMode mode;
  SkyFilter filter;
  SkyShift shift;
  bool brightening;                //!< multiplies the map's light by the magnification
  BlackbodyTable colours;          //!< for SkyShift::blackbody_fit
  ProjectionOf<float> projection;  //!< for brightening, and for rows on devices
  int first_row;                   //!< of the image in this batch, for brightening
  float exposure;                  //!< factor of the sky's light
  //! Value at the low end of a heat map, or its logarithm for logarithmic ones.
  float range_low;
  float range_high;
  //! With SkyFilter::polygon, contains each pixel's filtered light on input, in the format of cube
  //! map texels.
  float* rgba;
  int count;  //!< whole rows
};

}  // namespace ergodome
