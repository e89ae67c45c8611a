#pragma once

#include "kernels/launch/kernel.h"
#include "kernels/projection/projection.h"

// Composes objects that are already drawn with a picture.
namespace ergodome {

//! Objects in the pixels of a block of rows, in a backend's memory.
struct ObjectLayer {
  //! Four per pixel: linear light times the fraction of the pixel that objects cover, and that
  //! fraction; nullptr: no objects.
  const float* rgba = nullptr;
  //! One per pixel: Mino time from the object to the camera, for a photon seen with energy 1 [1/M].
  //! For an eye of the stereo model `flat`: minus the nearness, 1 / (distance from the eye in the
  //! head's flat space).
  const float* time = nullptr;
};

//! A block of rows of a picture over which objects are composed, without disk or shells: four
//! floats per pixel.
struct LayObjectsBatch {
  ObjectLayer objects;
  ProjectionOf<float> projection;
  int first_row;
  int row_count;
  float* rgba;
};

inline namespace ERGO_TARGET {

//! Composes the object of pixel i of the block with the picture.
struct LayObjects {
  LayObjectsBatch batch;

  ERGO_HD void operator()(int index) const {
    const float* const object = batch.objects.rgba + 4 * static_cast<long>(index);
    const float covered = object[3];
    if (!(covered > 0.0F)) {
      return;
    }
    const int width_px = batch.projection.width_px;
    const int row = index / width_px;
    const float x_px = static_cast<float>(index - row * width_px) + 0.5F;
    const float inside = image_coverage(batch.projection, x_px, static_cast<float>(row + batch.first_row) + 0.5F);
    float* const to = batch.rgba + 4 * static_cast<long>(index);
    for (int k = 0; k < 3; ++k) {
      to[k] = inside * object[k] + (1.0F - covered) * to[k];
    }
    to[3] = inside * covered + (1.0F - covered) * to[3];
  }
};

template <class T, class Action>
void dispatch(const LayObjectsBatch& batch, const Action& action) {
  action(LayObjects{batch});
}

}  // namespace ERGO_TARGET
template <>
struct Kernel<LayObjectsBatch> : KernelDefaults {
  static constexpr bool wide = false;
  static constexpr bool compiled_once = true;
  static constexpr int grain = 2048;
  static const char* name(const LayObjectsBatch& /*batch*/) { return "lay_objects"; }
  static int elements(const LayObjectsBatch& batch) { return batch.row_count * batch.projection.width_px; }
};

}  // namespace ergodome
