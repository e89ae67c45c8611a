#pragma once

#include "kernels/objects/object_quads.h"

// Draws objects for a camera or omnidirectional stereo.
namespace ergodome::inline ERGO_TARGET {

//! Order of the Taylor series of rays that search for objects.
inline constexpr int object_order = 10;

//! Finds the objects that rays of a camera, or of omnidirectional stereo, meet.
template <class T, NearParts Parts>
struct ObjectRaysOfEye {
  static constexpr int max_quads = 1;

  const ObjectPixelBatch& batch;

  [[nodiscard]] ERGO_HD PixelSlices slice(int at) const {
    const ObjectScene& objects = batch.objects;
    return slice_pixel(objects.camera, start_near_ray(objects.camera, objects.omni, middle_of_pixel(batch, at)));
  }

  ERGO_HD void find(int, const Vector3<T>* n, int count, SampleHits<T>* met) const {
    const ObjectScene& objects = batch.objects;
    const CameraStation& camera = objects.camera;
    for (int k = 0; k < count; ++k) {
      const NearRay<T> ray = start_near_ray(camera, objects.omni, n[k]);
      met[k].energy = ray.energy;
      met[k].momentum = ray.axial_angular_momentum;
      const T square = dot(n[k], n[k]);
      trace_meshes<object_order, Parts, T>(camera.spin, camera.cosine_phi, camera.sine_phi, ray, objects.scene,
                                           objects.limits, (square > T(0.5)) & (square < T(2.0)), met[k].hits);
    }
  }
};

//! Computes the light of pixels in which objects may be seen, from `samples`² rays each. Index i
//! covers pixels i * lanes to (i + 1) * lanes - 1.
template <class T, NearParts Parts>
struct LookAtObjects {
  ObjectPixelBatch batch;

  ERGO_HD void operator()(int index) const {
    const ObjectRaysOfEye<T, Parts> rays = {batch};
    ObjectQuads<T, ObjectRaysOfEye<T, Parts>>{batch, rays}.draw(index);
  }
};

template <class T, class Action>
void dispatch(const ObjectPixelBatch& batch, const Action& action) {
  dispatch_objects<LookAtObjects, T>(batch, action);
}

}  // namespace ergodome::inline ERGO_TARGET
