#pragma once

#include <optional>

#include "kernels/image/tone_curve.h"
#include "render/picture/heat_range.h"
#include "render/picture/pixel_values.h"

// The pictures that renderers make and outputs take.

namespace ergodome {

//! One eye's picture: linear light, four floats per pixel (red, green, blue, coverage), top row
//! first.
struct Picture {
  int width = 0;
  int height = 0;
  PixelValues rgba;
  const char* lens = "";       //!< source of the lens: LensSource::name()
  bool behind = false;         //!< LensSource::behind()
  long unresolved_pixels = 0;  //!< rays that did not converge; they show the mean of the sky
  std::optional<HeatRange> heat_range;
  Tone tone;  //!< for display
};

//! A picture in the backend's memory: four floats per pixel.
struct PictureInPlace {
  float* rgba = nullptr;
  const char* lens = "";  //!< as in Picture
  bool behind = false;
};

}  // namespace ergodome
