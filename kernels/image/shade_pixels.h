#pragma once

#include <cstdint>

#include "kernels/image/lens_pixels.h"
#include "kernels/launch/kernel.h"
#include "kernels/projection/projection.h"
#include "kernels/sky/blackbody.h"
#include "kernels/sky/cube_map.h"
#include "kernels/sky/sky_sampling.h"

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
  bool brightening;                //!< true: the map's light is multiplied by the magnification
  BlackbodyTable colours;          //!< colors of blackbodies; used by SkyShift::blackbody_fit
  ProjectionOf<float> projection;  //!< projection of the image, for magnifications and for the width of a row
  int first_row;                   //!< row of the image at which this batch begins, for magnifications
  float exposure;                  //!< factor of the sky's light
  //! Value at the low end of a heat map: log10 of error estimate and magnification, log2 of the
  //! frequency ratio, other channels as they are.
  float range_low;
  float range_high;
  //! On output, the color of each pixel. With SkyFilter::polygon, contains each pixel's filtered
  //! light on input, with the four numbers that CubeMap describes.
  float* rgba;
  int count;  //!< number of pixels; whole rows
  //! True: the fourth channel is 0 instead of the coverage, and what is drawn over the sky adds its
  //! opacity.
  bool opacity = false;
};

//! Returns the work counter's name for a variant of shading the sky; each variant is compiled
//! separately.
constexpr const char* shading_name(SkyFilter filter, SkyShift shift, bool brightening) {
  constexpr const char* names[3][3][2] = {
      {{"shade_sky", "shade_sky, brightening"},
       {"shade_sky, luminance", "shade_sky, luminance, brightening"},
       {"shade_sky, blackbody_fit", "shade_sky, blackbody_fit, brightening"}},
      {{"shade_sky, point", "shade_sky, point, brightening"},
       {"shade_sky, point, luminance", "shade_sky, point, luminance, brightening"},
       {"shade_sky, point, blackbody_fit", "shade_sky, point, blackbody_fit, brightening"}},
      {{"shade_sky, polygon", "shade_sky, polygon, brightening"},
       {"shade_sky, polygon, luminance", "shade_sky, polygon, luminance, brightening"},
       {"shade_sky, polygon, blackbody_fit", "shade_sky, polygon, blackbody_fit, brightening"}}};
  return names[static_cast<int>(filter)][static_cast<int>(shift)][brightening ? 1 : 0];
}

template <>
struct Kernel<ShadeBatch> : KernelDefaults {
  static const char* name(const ShadeBatch& batch) {
    return batch.mode == ViewMode::sky ? shading_name(batch.filter, batch.shift, batch.brightening) : "shade_heat_map";
  }
  static PixelRows rows(const ShadeBatch& batch) {
    return {batch.projection.width_px, batch.count / batch.projection.width_px};
  }

  template <class Visit>
  static void visit_outputs(const ShadeBatch& batch, const Visit& visit) {
    visit("rgba", batch.rgba, 4L * batch.count);
  }
};

}  // namespace ergodome
