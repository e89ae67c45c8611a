#pragma once

#include "kernels/core/host_device.h"
#include "kernels/core/vector3.h"

// Parts of the sky in which the search seeks the stars of a patch.
namespace ergodome {

//! Orthonormal axes of the sky, aligned with a patch.
struct PatchFrame {
  Vector3<double> first;   //!< along the patch's long side
  Vector3<double> second;  //!< along its narrow side
  Vector3<double> axis;    //!< to its middle
};

//! Range of heights and azimuths of a part of the sky.
struct SkyBounds {
  float low;          //!< minimum height z
  float high;         //!< maximum height z
  float turns;        //!< where its azimuths begin, in [0, 1)
  float width_turns;  //!< range of azimuths; 1 about a pole
};

//! A frustum in which stars are sought.
struct SkyPart {
  float inward[4][3];  //!< inward normals of its four sides
  SkyBounds bounds;
};

//! A rotation by φ about z.
struct SkyTurn {
  float turns;  //!< in [0, 1)
  float sine;
  float cosine;
};

inline namespace ERGO_TARGET {

//! Returns the part after mirroring it at the equator, if `mirrored`, and then rotating it.
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
