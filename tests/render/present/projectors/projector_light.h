#pragma once

#include <algorithm>
#include <cmath>

// The formula for the values that projectors receive.

namespace ergodome {

//! How a projector changes one color channel at one position of its raster.
struct ProjectorColour {
  //! Factor on the light at that position: the warp's intensity times the blend mask.
  float factor = 1.0F;
  //! Minimum light at the position, as a fraction of full light, from the black level mask.
  float lift = 0.0F;
  float gain = 1.0F;   //!< gain of the projector
  float gamma = 2.2F;  //!< gamma of the projector: light = value ^ gamma
};

//! Returns the value, 0 to 1, that a projector receives for a master's tone-mapped light, 0 to 1.
//! ProjectorDrawing's shader computes the same; tests compare the two.
//!
//! All steps but the last use linear light, in which light of several projectors adds up. The blend
//! comes before the lift, because overlapping projectors share the picture but each keeps its own
//! black. The lift is VESA MPCDI 2.0, 2.4: Pf = Pi alpha (1 - beta) + beta, which leaves full light
//! unchanged. The gain matches projectors, including their lifted blacks. The projector's own curve
//! comes last.
inline float projector_value(const ProjectorColour& colour, float light) {
  const float blended = light * colour.factor;
  const float lifted = blended * (1.0F - colour.lift) + colour.lift;
  return std::pow(std::clamp(colour.gain * lifted, 0.0F, 1.0F), 1.0F / colour.gamma);
}

}  // namespace ergodome
