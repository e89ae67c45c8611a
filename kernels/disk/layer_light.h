#pragma once

#include "kernels/disk/disk_light.h"
#include "kernels/near_rays/near_ray.h"
#include "kernels/near_rays/seen_light.h"
#include "kernels/spacetime/kerr/horizon_winding.h"

// Adds the disk's light at crossings that are read from a grid.
namespace ergodome::inline ERGO_TARGET {

//! A layer of crossings (kernels/disk/crossing_layers.h) as one sample of a pixel sees it.
struct SeenLayer {
  float u;      //!< 1/r in the middle of the sample [1/M]
  float width;  //!< change of u across the sample
  //! Cosine and sine of the azimuth relative to the camera's, minus the winding; only with a
  //! pattern.
  float cosine;
  float sine;
  //! Time from emission to the camera, minus that of the winding [M]; only with a pattern.
  float delay;
  bool outwards;  //!< the light was emitted outwards
};

//! Composites the disk's light at a crossing behind everything that lane `i` has seen so far.
template <bool WithPattern, class T>
ERGO_HD void put_layer_behind(const CameraStationOf<float>& camera, const DiskAppearance& appearance,
                              const SeenLayer& layer, const PhotonConstants& photon, int i, SeenLanes<T>& seen) {
  const detail::DiskSpan span = detail::disk_span(appearance.inner_r, appearance.outer_r, layer.u, layer.width);
  const float opacity = appearance.opacity * span.coverage;
  // Also true for a NaN opacity, which then hides nothing.
  if (!(opacity > 0.0F)) {
    return;
  }
  SeenCrossing at = {span.coverage, span.r, layer.width * span.r, layer.outwards, 0.0F, 0.0F};
  if constexpr (WithPattern) {
    const HorizonWinding<float> horizon = horizon_winding(camera.spin, is_within_horizon(camera));
    const float wound = winding(horizon, 1.0F / span.r);
    at.phi = ::atan2f(layer.sine, layer.cosine) + winding_turn(horizon) * wound +
             ::atan2f(camera.sine_phi, camera.cosine_phi);
    at.delay = layer.delay + winding_delay(horizon) * wound;
  }
  put_behind(opacity * disk_light(appearance, photon, at), opacity, i, seen);
}

//! Returns the constants of motion of lane `i` of a pack of rays.
template <class T>
ERGO_HD PhotonConstants photon_constants(const NearRay<T>& ray, int i) {
  return {lane(value_of(ray.energy), i), lane(value_of(ray.axial_angular_momentum), i),
          lane(value_of(ray.shear_constant), i), lane(value_of(ray.carter), i)};
}

}  // namespace ergodome::inline ERGO_TARGET
