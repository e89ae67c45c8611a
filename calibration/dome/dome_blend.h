#pragma once

#include <vector>

#include "calibration/dome/dome_warp.h"
#include "calibration/projectors/blend_map.h"

namespace ergodome {

//! How projectors share the dome.
struct BlendSettings {
  //! Parts are as these powers of the depths in the rasters: 1 leaves kinks at the seams' ends, 2 or more none.
  double softness = 2.0;
  //! From 0, light as it falls, to 1, as even as the dimmest place: where a raster is spread over more of the dome it is dimmer. In
  //! between, light goes with that power of what it falls short.
  double evenness = 1.0;
};

//! The light of several projectors on one dome: where they overlap, their parts are 1 together. Each is taken to spread the same light
//! evenly over its raster.
class DomeBlend {
 public:
  //! Throws Error where no projector lights the dome. The projectors are copied.
  DomeBlend(std::vector<ProjectorOptics> projectors, const DomeScreen& screen, const BlendSettings& settings);

  //! A projector's part in the light at one of its places, 0 to 1.
  [[nodiscard]] double part(std::size_t projector, const RasterPlace& place) const;

  //! What the linear values there are to be multiplied with, 0 to 1: the part, and what makes the dome even.
  [[nodiscard]] double intensity(std::size_t projector, const RasterPlace& place) const;

  //! Intensities of all pixels of a raster, for linear values (blend_mask_gamma 1), as a grey mask of 16 bits.
  [[nodiscard]] BlendMap mask(std::size_t projector, int width_px, int height_px) const;

  //! What mask() gives, in a small part of the time, from the mask that the blend of another tilt of the same dome gave, from a file of 16
  //! bits, too: a tilt changes what light all places can have, which is one factor, and where that mask was cut off at 1 it is computed anew.
  //! Pixels far beyond the dome's rim keep what they had. `before`: that blend.
  [[nodiscard]] BlendMap mask_after_tilt(std::size_t projector, const BlendMap& mask, const DomeBlend& before) const;

  [[nodiscard]] const std::vector<ProjectorOptics>& projectors() const { return projectors_; }

 private:
  [[nodiscard]] double evened_light(std::size_t projector, const RasterPlace& place) const;

  std::vector<ProjectorOptics> projectors_;
  DomeScreen screen_;
  BlendSettings settings_;
  double level_ = 1.0;  //!< the light, to the power of evenness, that all places can have
};

}  // namespace ergodome
