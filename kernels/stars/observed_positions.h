#pragma once

#include "kernels/launch/kernel.h"
#include "kernels/lens/lens_chart.h"
#include "kernels/spacetime/kerr/camera_station.h"
#include "kernels/spacetime/kerr/frame_boost.h"

namespace ergodome {

//! Computes what an observer sees at positions of the chart.
struct ObservedPositionBatch {
  LensChart chart;
  //! Energy at infinity of light that arrives from a rain-frame direction with energy 1.
  DirectionForm<float> energy;
  AberrationOf<float> observer;  //!< aberration from the observer's frame to the rain frame
  int count;
  const float* gamma_turns;
  const float* s;
  float* direction[3];     //!< out: unit vectors in the observer's frame
  float* area;             //!< out: the observer's solid angle per area of the chart [sr/turn]
  float* frequency_ratio;  //!< out: g
};

template <>
struct Kernel<ObservedPositionBatch> : KernelDefaults {
  static constexpr bool counted = false;
  static const char* name(const ObservedPositionBatch& /*batch*/) { return "observe_places"; }
  static int elements(const ObservedPositionBatch& batch) { return batch.count; }
};

}  // namespace ergodome
