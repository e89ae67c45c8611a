#pragma once

namespace ergodome {

//! What the lens does to each pixel of an image, row by row from the top: where its light comes from, and how.
//!
//! One array a channel, an element a pixel. A null pointer is a channel that the scene does not call for.
struct LensPixels {
  float* sky
      [3];  //!< unit vector to the source on the celestial sphere; 0 where light is lost and nobody asked for derivatives
  float* sky_along_x[3];   //!< its derivative per pixel to the right
  float* sky_along_y[3];   //!< its derivative per pixel downwards
  float* coverage;         //!< fraction of the pixel that the sky lights: 0 in the shadow and outside the image
  float* frequency_ratio;  //!< g = ν_observed / ν_emitted
  float* steps;            //!< integration steps
  float* error_estimate;   //!< the integrator's own [rad]; negative: the ray did not converge
  float* half_orbits;      //!< angle swept about the hole, in units of π: the order of the image
};

//! Whether the scene calls for footprints: kernels have a variant without.
constexpr bool has_footprints(const LensPixels& pixels) { return pixels.sky_along_x[0] != nullptr; }

}  // namespace ergodome
