#pragma once

#include "kernels/core/host_device.h"
#include "kernels/core/vector3.h"

namespace ergodome {

//! Axes of the sky by which a patch is narrow: unit vectors across each other.
struct PatchFrame {
  Vector3<double> first;   //!< the way the patch is long
  Vector3<double> second;  //!< the way it is narrow
  Vector3<double> axis;    //!< to its middle
};

//! What a part of the sky has of heights and azimuths.
struct SkyBounds {
  float low;          //!< least height z
  float high;         //!< greatest
  float turns;        //!< where its azimuths begin, in [0, 1)
  float width_turns;  //!< and how far they go on; 1 about a pole
};

//! A frustum as stars are sought in it.
struct SkyPart {
  float inward[4][3];  //!< its four sides
  SkyBounds bounds;
};

//! A turn by φ about z.
struct SkyTurn {
  float turns;  //!< in [0, 1)
  float sine;
  float cosine;
};

inline namespace ERGO_TARGET {

//! The part after the sky's mirror image across the equator, if `mirrored`, and then a turn.
ERGO_HD SkyPart turned(const SkyPart& part, const SkyTurn& turn, bool mirrored) {
  SkyPart other;
  for (int side = 0; side < 4; ++side) {
    const float(&n)[3] = part.inward[side];
    other.inward[side][0] = turn.cosine * n[0] - turn.sine * n[1];
    other.inward[side][1] = turn.sine * n[0] + turn.cosine * n[1];
    other.inward[side][2] = mirrored ? -n[2] : n[2];
  }
  const SkyBounds& bounds = part.bounds;
  const float turns = bounds.turns + turn.turns;
  other.bounds = {mirrored ? -bounds.high : bounds.low, mirrored ? -bounds.low : bounds.high,
                  turns < 1.0F ? turns : turns - 1.0F, bounds.width_turns};
  return other;
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
