#pragma once

#include "kernels/lens/lens_chart.h"
#include "kernels/spacetime/kerr/camera_station.h"
#include "kernels/spacetime/kerr/frame_boost.h"
#include "kernels/stars/search/bezier_patch.h"

namespace ergodome {

//! What a patch does to solid angles and to light, from samples all over it.
struct PatchMeasures {
  float lowest_sky;       //!< least of the sky's signed area per chart area [1/turn]
  float highest_sky;      //!< and greatest
  float greatest_camera;  //!< most of the solid angle of the rain frame's camera per chart area [sr/turn]
  float greatest_ratio;   //!< of the camera's to the sky's
  float brightening;      //!< most of the observer's solid angles over the rain frame's
  float frequency_ratio;  //!< greatest g, to the observer
  Vector3<float> seen;    //!< the way to its middle in the observer's frame
  float seen_radius;      //!< greatest distance from there, as a chord between unit vectors
  bool regular;           //!< as in PatchShape, if it is not folded
};

//! A patch in its own frame (PatchFrame), and its place in the chart.
struct PatchMeasureBatch {
  const BezierPatch* patch;
  LensChart chart;
  float gamma_turns;
  float s;
  float width_turns;
  float height;
  DirectionForm<float> energy;   //!< at infinity, of light that comes from a rain-frame direction with an energy of 1
  AberrationOf<float> observer;  //!< to the rain frame
  PatchMeasures* out;
};

}  // namespace ergodome
