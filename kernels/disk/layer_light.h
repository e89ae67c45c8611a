#pragma once

#include "kernels/disk/disk_light.h"
#include "kernels/near_rays/horizon_winding.h"
#include "kernels/near_rays/near_ray.h"
#include "kernels/near_rays/seen_light.h"

namespace ergodome::inline ERGO_TARGET {

//! A layer of crossings (kernels/disk/crossing_layers.h) as a part of one pixel sees it.
struct SeenLayer {
  float u;       //!< 1/r in its middle [1/M]
  float width;   //!< how far that changes across it
  float cosine;  //!< of the azimuth from the camera's, less the winding; with a pattern alone
  float sine;
  float delay;    //!< less the winding's [M]; with a pattern alone
  bool outwards;  //!< the light was emitted so
};

//! Puts the disk's light at a crossing behind what lane `i` has seen.
template <bool WithPattern, class T>
ERGO_HD void put_layer_behind(const CameraStationOf<float>& camera, const DiskLook& look, const SeenLayer& layer,
                              const PhotonConstants& photon, int i, SeenLanes<T>& seen) {
  const detail::DiskSpan span = detail::disk_span(look.inner_r, look.outer_r, layer.u, layer.width);
  const float opacity = look.opacity * span.coverage;
  // A number that is not one covers nothing.
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
  put_behind(opacity * disk_light(look, photon, at), opacity, i, seen);
}

//! The constants of lane `i` of a register of rays.
template <class T>
ERGO_HD PhotonConstants photon_constants(const NearRay<T>& ray, int i) {
  return {lane(value_of(ray.energy), i), lane(value_of(ray.axial_angular_momentum), i),
          lane(value_of(ray.shear_constant), i), lane(value_of(ray.carter), i)};
}

}  // namespace ergodome::inline ERGO_TARGET
