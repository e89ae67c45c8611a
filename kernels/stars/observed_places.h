#pragma once

#include "kernels/lens/lens_chart.h"
#include "kernels/spacetime/kerr/camera_station.h"
#include "kernels/spacetime/kerr/frame_boost.h"

namespace ergodome {

//! What an observer sees at places of the chart.
struct ObservedPlaceBatch {
  LensChart chart;
  DirectionForm<float> energy;   //!< at infinity, of light that comes from a rain-frame direction with an energy of 1
  AberrationOf<float> observer;  //!< to the rain frame
  int count;
  const float* gamma_turns;
  const float* s;
  float* direction[3];     //!< out: unit vectors in the observer's frame
  float* area;             //!< out: his solid angle per area of the chart [sr/turn]
  float* frequency_ratio;  //!< out: g
};

}  // namespace ergodome
