#pragma once

#include <algorithm>
#include <cmath>

namespace ergodome {

//! What a projector does to one colour at one place of its raster.
struct ProjectorColour {
  float factor = 1.0F;  //!< of the light there: the warp's intensity times the blend mask
  float lift = 0.0F;    //!< part of full light that the place never falls below: that of the black level
  float gain = 1.0F;    //!< of the projector
  float gamma = 2.2F;   //!< of the projector: light = value ^ gamma
};

//! The value, 0 to 1, that a projector is sent for a master's toned light, 0 to 1. The shader of ProjectorDrawing says the same.
//!
//! All but the last step is in linear light, where light of several projectors adds up. The blend comes before the lift, because parts
//! that overlap share the picture but each projector keeps its own black; the lift is VESA MPCDI 2.0, 2.4: Pf = Pi alpha (1 - beta) +
//! beta, which leaves full light as it is. The gain evens out projectors, their lifted blacks too. The projector's own curve comes last.
inline float projector_value(const ProjectorColour& colour, float light) {
  const float blended = light * colour.factor;
  const float lifted = blended * (1.0F - colour.lift) + colour.lift;
  return std::pow(std::clamp(colour.gain * lifted, 0.0F, 1.0F), 1.0F / colour.gamma);
}

}  // namespace ergodome
