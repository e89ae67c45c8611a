#pragma once

#include "content/show/show.h"
#include "kernels/image/shade_pixels.h"

// How the sky map is shaded, and which lens channels a picture of the sky or a heat map needs.

namespace ergodome {

//! Which channels of LensPixels a picture needs.
struct LensChannels {
  bool sky = false;        //!< sky direction: three floats
  bool footprint = false;  //!< footprint of the pixel on the sky: six floats
  bool frequency_ratio = false;
  bool steps = false;
  bool half_orbits = false;

  //! Returns the number of floats per pixel, including coverage and error estimate, which every
  //! picture has.
  [[nodiscard]] int floats() const {
    return 2 + (sky ? 3 : 0) + (footprint ? 6 : 0) + (frequency_ratio ? 1 : 0) + (steps ? 1 : 0) +
           (half_orbits ? 1 : 0);
  }
};

//! How the map's light is turned into pixel values.
struct SkyShading {
  SkyFilter filter = SkyFilter::ewa;
  SkyShift shift = SkyShift::none;
  bool brightening = false;
};

inline SkyShading shading_of(const Show& show) {
  return {show.sky.filter, show.effects.redshift ? show.sky.shift : SkyShift::none, show.sky.brightening};
}

inline LensChannels lens_channels(ViewMode mode, const SkyShading& shading) {
  const bool sky = mode == ViewMode::sky;
  const bool wide = shading.filter != SkyFilter::point || shading.brightening;
  const bool shifted = shading.shift != SkyShift::none;
  return {sky, (sky && wide) || mode == ViewMode::magnification, (sky && shifted) || mode == ViewMode::frequency_ratio,
          mode == ViewMode::steps, mode == ViewMode::image_order};
}

}  // namespace ergodome
