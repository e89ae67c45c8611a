#pragma once

namespace ergodome {

//! Effect of the lens on each pixel of an image, row by row from the top: the source of its light,
//! and what happened to the light on the way.
//!
//! One array per channel, one element per pixel. A channel that the scene does not need is null.
struct LensPixels {
  //! Unit vector to the source on the celestial sphere. Where light is lost: 0 in scenes without
  //! footprints, otherwise an arbitrary direction with a footprint as wide as the sky.
  float* sky[3];
  float* sky_along_x[3];   //!< derivative of `sky` per pixel to the right
  float* sky_along_y[3];   //!< derivative of `sky` per pixel downwards
  float* coverage;         //!< fraction of the pixel that the sky lights
  float* frequency_ratio;  //!< g = ν_observed / ν_emitted
  float* steps;            //!< number of integration steps of the ray
  //! The integrator's estimate of the error of `sky` [rad]; negative: not converged.
  float* error_estimate;
  float* half_orbits;  //!< angle swept about the hole, in units of π: the order of the image
};

//! Returns whether footprints are wanted; kernels have a variant without.
constexpr bool has_footprints(const LensPixels& pixels) { return pixels.sky_along_x[0] != nullptr; }

//! Calls visit(channel, values, count) for the channels of `count` pixels.
template <class Visit>
void visit_channels(const LensPixels& pixels, long count, const Visit& visit) {
  for (int axis = 0; axis < 3; ++axis) {
    visit("sky", pixels.sky[axis], count);
    visit("sky_along_x", pixels.sky_along_x[axis], count);
    visit("sky_along_y", pixels.sky_along_y[axis], count);
  }
  visit("coverage", pixels.coverage, count);
  visit("frequency_ratio", pixels.frequency_ratio, count);
  visit("steps", pixels.steps, count);
  visit("error_estimate", pixels.error_estimate, count);
  visit("half_orbits", pixels.half_orbits, count);
}

}  // namespace ergodome
