#pragma once

#include "kernels/core/vector3.h"

// A point light, and corrections that are kept to find its rays faster.
namespace ergodome {

//! How light weakens with distance.
enum class LampFalloff {
  lens,      //!< as bundles of rays spread in curved space
  published  //!< with the square of the light's travel time: Müller, Schulz & Weiskopf (2021), eq. 20
};

//! A point light at rest.
struct LampSource {
  Vector3<double> position;  //!< the light's position, pseudo-Cartesian [M]
  double strength;           //!< as PointLight::strength; 0: no lamp
  LampFalloff falloff = LampFalloff::lens;
  //! With falloff `lens`: light is shifted and beamed between the lamp and the moving surface.
  bool shifted = false;
};

//! The change of a ray between two points by the spin, as a first guess for a nearby target; 0:
//! unknown.
struct RayCorrection {
  Vector3<double> direction;  //!< change of the direction by the spin, for aim_with_spin
  double gamma, x;            //!< changes of γ and x by the spin, for aim_round_with_spin
};

//! Corrections of a lamp's rays to a point, for both ways round the hole.
struct LampCorrections {
  RayCorrection by_way[2];
};

}  // namespace ergodome
