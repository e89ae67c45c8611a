#pragma once

#include "kernels/core/vector3.h"

namespace ergodome {

//! How light grows fainter on its way.
enum class LampFalloff {
  lens,      //!< as its bundles spread about the hole
  published  //!< with the square of its travel time: Müller, Schulz & Weiskopf (2021), eq. 20
};

//! A point of light at rest.
struct LampPlace {
  Vector3<double> position;  //!< pseudo-Cartesian [M]
  double strength;           //!< 0: there is none
  LampFalloff falloff = LampFalloff::lens;
  bool shifted =
      false;  //!< with falloff `lens`: light is shifted and beamed between the lamp and the surface as that moves
};

//! What spin adds to a ray between two places, as it is aimed at a place near by; 0: not known.
struct RayCorrection {
  Vector3<double> direction;  //!< aim_with_spin
  double gamma, x;            //!< aim_round_with_spin
};

//! The same of a lamp's rays to a place on both ways.
struct LampCorrections {
  RayCorrection by_way[2];
};

}  // namespace ergodome
