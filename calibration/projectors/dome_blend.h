#pragma once

#include <vector>

#include "calibration/projectors/dome_warp.h"
#include "calibration/warps/blend_map.h"

namespace ergodome {

//! Settings of the edge blend: how much light each of several overlapping projectors contributes.
struct BlendSettings {
  //! In an overlap, each projector's share is proportional to this power of
  //! ProjectorOptics::depth(). 1 leaves visible edges at the ends of seams; 2 or more does not.
  double softness = 2.0;
  //! 0: no equalization; 1: the whole dome is as bright as its dimmest point. Between these,
  //! brightness differences remain with the power 1 - evenness. They exist because a raster that is
  //! spread over a larger area of the dome is dimmer.
  double evenness = 1.0;
};

//! The light of several projectors on one dome: in overlaps their shares add up to 1. All
//! projectors are assumed to be equally bright, with uniform light over the raster.
class DomeBlend {
 public:
  //! Throws Error if no projector lights the dome. Copies the projectors.
  DomeBlend(std::vector<ProjectorOptics> projectors, const DomeScreen& screen, const BlendSettings& settings);

  //! Returns a projector's share of the light at a position of its raster, 0 to 1.
  [[nodiscard]] double part(std::size_t projector, const RasterPosition& position) const;

  //! Returns the factor for linear values at a position of the raster, 0 to 1: the share times the
  //! equalization.
  [[nodiscard]] double intensity(std::size_t projector, const RasterPosition& position) const;

  //! Returns the intensities of all pixels of a raster, for linear values (blend_mask_gamma 1), as
  //! a gray mask of 16 bits.
  [[nodiscard]] BlendMap mask(std::size_t projector, int width_px, int height_px) const;

  //! Returns the same as mask() in a fraction of the time, from the mask of `before`, the blend at
  //! another tilt of the same dome; that mask may come from a 16-bit file. A tilt only changes the
  //! light level of the whole dome, which is one factor. Pixels that were clamped at 1 are
  //! recomputed. Pixels far beyond the dome's rim keep their values.
  [[nodiscard]] BlendMap mask_after_tilt(std::size_t projector, const BlendMap& mask, const DomeBlend& before) const;

  [[nodiscard]] const std::vector<ProjectorOptics>& projectors() const { return projectors_; }

 private:
  [[nodiscard]] double evened_light(std::size_t projector, const RasterPosition& position) const;

  std::vector<ProjectorOptics> projectors_;
  DomeScreen screen_;
  BlendSettings settings_;
  //! Brightness that every point of the dome can reach, to the power of `evenness`.
  double level_ = 1.0;
};

}  // namespace ergodome
