#pragma once

#include "kernels/launch/kernel.h"
#include "kernels/lens/lens_chart.h"
#include "kernels/spacetime/kerr/camera_station.h"
#include "kernels/spacetime/kerr/frame_boost.h"
#include "kernels/stars/search/bezier_patch.h"

namespace ergodome {

//! How a patch changes solid angles and light, from samples all over it.
struct PatchMeasures {
  float lowest_sky;   //!< minimum signed area of the sky per area of the chart [1/turn]
  float highest_sky;  //!< maximum signed area of the sky per area of the chart [1/turn]
  //! Maximum solid angle of the rain frame's camera per area of the chart [sr/turn].
  float largest_camera;
  float max_ratio;        //!< maximum ratio of the camera's solid angle to the sky's
  float brightening;      //!< maximum ratio of the observer's solid angles to the rain frame's
  float frequency_ratio;  //!< maximum g for the observer
  Vector3<float> seen;    //!< direction to the patch's middle in the observer's frame
  float seen_radius;      //!< maximum distance from that direction, as a chord between unit vectors
  bool regular;           //!< if the patch is not folded: its shape is PatchShape::regular
};

//! A patch to be measured, in its own frame (PatchFrame), and its rectangle in the chart.
struct PatchMeasureBatch {
  const BezierPatch* patch;
  LensChart chart;
  float gamma_turns;
  float s;
  float width_turns;
  float height;
  //! Energy at infinity of light that arrives from a rain-frame direction with energy 1.
  DirectionForm<float> energy;
  AberrationOf<float> observer;  //!< aberration from the observer's frame to the rain frame
  PatchMeasures* out;
};

template <>
struct Kernel<PatchMeasureBatch> : KernelDefaults {
  static constexpr bool counted = false;
  static const char* name(const PatchMeasureBatch& /*batch*/) { return "measure_patch"; }
  static int elements(const PatchMeasureBatch& /*batch*/) { return 1; }
};

}  // namespace ergodome
