#pragma once

#include <cstdint>

#include "kernels/image/lens_pixels.h"
#include "kernels/projection/projection.h"
#include "kernels/sky/blackbody.h"
#include "kernels/sky/cube_map.h"
#include "kernels/sky/sky_look.h"

namespace ergodome {

//! What a picture shows of the lens: the sky itself, or a heat map of one of its channels.
enum class ViewMode : std::int32_t { sky, steps, error_estimate, image_order, frequency_ratio, magnification };

//! Pixels to turn into light. Colour is linear and scene-referred, four floats a pixel (the fourth is the coverage).
struct ShadeBatch {
  LensPixels lens;
  CubeMap sky;  //!< not looked at by SkyFilter::polygon
  ViewMode mode;
  SkyFilter filter;
  SkyShift shift;
  bool brightening;                //!< the map's light is multiplied by the magnification
  BlackbodyTable colours;          //!< for SkyShift::blackbody_fit
  ProjectionOf<float> projection;  //!< of the image: for brightening, and for how devices go through its rows
  int first_row;                   //!< of the image in this batch, for brightening
  float exposure;                  //!< factor on the sky's light
  float range_low;                 //!< value at the low end of a heat map (its logarithm for logarithmic ones)
  float range_high;
  float* rgba;  //!< with SkyFilter::polygon it comes with each pixel's filtered light, as the cube map's texels hold it
  int count;    //!< whole rows
};

}  // namespace ergodome
