#pragma once

#include <vector>

#include "kernels/projection/projection.h"
#include "render/lens/eye_camera.h"
#include "render/stars/star_finder.h"

namespace ergodome {

//! How points become pixels.
struct SplatSettings {
  double sigma_px = 0.0;  //!< of a Gaussian, cut off at three of them; 0: each image in the pixel that it falls on
  float scale = 1.0F;     //!< picture value of a luminance of 1 cd/m²
};

//! Adds images of stars to rows [first_row, first_row + row_count) of a picture in host memory: four floats a pixel, linear light.
//!
//! A pixel receives the illuminance that falls on it over its solid angle, which is a luminance like that of the map. The weights of an
//! image's pixels add up to 1, wherever between pixels it lies: its light does not depend on the spread, nor on the resolution.
void splat_stars(const std::vector<StarImage>& images, const EyeCamera& eye, const Projection& projection,
                 const SplatSettings& settings, int first_row, int row_count, float* rgba);

}  // namespace ergodome
