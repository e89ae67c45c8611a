#pragma once

#include "kernels/disk/disk_appearance.h"
#include "kernels/disk/equatorial_crossings.h"

// Light of the disk as a pixel sees it.
namespace ergodome::inline ERGO_TARGET {

namespace detail {

//! Returns ln T at a radius.
ERGO_HD float log_temperature_at(const DiskProfileTable& table, float r) {
  const float position = sqrt(maximum(1.0F - table.first_r / r, 0.0F)) / table.step;
  const float clamped = minimum(position, static_cast<float>(table.count - 1));
  const int i = static_cast<int>(clamped) < table.count - 1 ? static_cast<int>(clamped) : table.count - 2;
  const float t = clamped - static_cast<float>(i);
  const float temperature = table.temperature[i] + t * (table.temperature[i + 1] - table.temperature[i]);
  return ::logf(maximum(temperature, 1e-3F));
}

//! The part of a disk that a pixel sees: the covered fraction of the pixel, and the radius in the
//! middle of that part.
struct DiskSpan {
  float coverage;
  float r;
};

//! Returns the part of the disk that a pixel sees at u = 1/r. `width`: change of u across the
//! pixel. The pixel sees the range u ± width/2, and the coverage is the fraction of this range
//! between the disk's edges. u varies smoothly even across infinity (u = 0), so an image thinner
//! than a pixel gets the right coverage.
ERGO_HD DiskSpan disk_span(float inner_r, float outer_r, float u, float width) {
  const float w = maximum(width, 1e-6F / inner_r);
  const float low = maximum(u - 0.5F * w, 1.0F / outer_r);
  const float high = minimum(u + 0.5F * w, 1.0F / inner_r);
  const float middle = minimum(maximum(0.5F * (low + high), 1.0F / outer_r), 1.0F / inner_r);
  return {minimum(maximum((high - low) / w, 0.0F), 1.0F), 1.0F / middle};
}

}  // namespace detail

//! Returns whether a pixel may contain images that are finer than itself. `change`: change of 1/r
//! across the pixel. Next to the critical curve the image of each order is thinner than that of the
//! order before, by a factor of about e^π without spin.
ERGO_HD bool holds_finer(const DiskAppearance& appearance, float change) {
  // Minimum change of 1/r across a pixel, as a fraction of the disk's whole range.
  constexpr float fine_change = 0.25F;
  return change > fine_change * (1.0F / appearance.inner_r - 1.0F / appearance.outer_r);
}

//! A crossing of the disk's plane as one pixel sees it.
struct SeenCrossing {
  float coverage;  //!< fraction of the pixel that the disk covers
  float r;         //!< radius in the middle of the covered part [M]
  float blur;      //!< change of r across the pixel, relative to r
  bool outwards;
  float phi;    //!< Boyer-Lindquist azimuth [rad], for the pattern
  float delay;  //!< coordinate time from emission to the camera [M], for the pattern
};

//! Constants of motion of a photon; see NearRay.
struct PhotonConstants {
  float energy;
  float axial_angular_momentum;
  float shear_constant;
  float carter;
};

//! Returns the light of the disk at a crossing as picture values, with exposure, in linear sRGB.
//!
//! Intensity over the cube of the frequency is constant along a ray, so a blackbody of temperature
//! T is seen as one of temperature g T; this includes both shift and beaming.
ERGO_HD Vector3<float> disk_light(const DiskAppearance& appearance, const PhotonConstants& photon,
                                  const SeenCrossing& at) {
  const float r = at.r;
  const float frequency = disk_frequency(
      appearance.flow, {r, photon.energy, photon.axial_angular_momentum, photon.shear_constant, at.outwards});
  // Linear extrapolation across a pixel may give a radius at which this light cannot exist. If the
  // frequency is then not positive, g = 0 makes the light dark where shifts are applied.
  const float g = frequency > 1e-30F ? 1.0F / frequency : 0.0F;
  const float shift = appearance.shifted ? ::logf(maximum(g, 1e-30F)) : 0.0F;
  const Vector3<float> seen =
      read_blackbody(appearance.colours, detail::log_temperature_at(appearance.profile, r) + shift);
  float luminance = appearance.exposure * ::expf(minimum(seen.x - appearance.log_unit, 80.0F));
  if (appearance.limb_darkened) {
    // Cosine of the emission angle: p_θ over the emitted energy. I = (1 + 2.06 μ) / 2.37 of the
    // mean (Chandrasekhar 1950).
    const float cosine = minimum(g * safe_sqrt(photon.carter) / r, 1.0F);
    luminance *= (1.0F + 2.06F * cosine) / (1.0F + 2.06F * 2.0F / 3.0F);
  }
  if (appearance.contrast > 0.0F) {
    const float rotation = 1.0F / (r * sqrt(r) + appearance.flow.spin);
    const float clouds = disk_pattern(appearance.pattern, r, at.phi, rotation, at.delay, at.blur);
    luminance *= ::expf(appearance.contrast * clouds);
  }
  return displayable(linear_srgb(Vector3<float>{seen.y, 1.0F, seen.z}), luminance);
}

}  // namespace ergodome::inline ERGO_TARGET
