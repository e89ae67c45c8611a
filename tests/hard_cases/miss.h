#pragma once

#include <cmath>

#include "tests/hard_cases/lens_methods.h"

// Exact rays, and the errors of a method against them.
namespace ergodome::test {

inline double length(const Vector3<double>& v) { return std::sqrt(dot(v, v)); }

//! The exact result of a ray, by elliptic functions, and its derivatives, by a Taylor series of
//! order 20.
struct ExactRay {
  bool bright;
  Vector3<double> sky;
  Vector3<double> along[2];  //!< derivatives of the sky along two axes of the camera's sky
  double stretch;            //!< size of the derivatives: amplifies an error of the direction on the sky
};

std::vector<ExactRay> exact_rays(const CameraStation& camera, const Directions& rays);

//! Returns the displacement on the camera's sky [rad] that produces a small error of the sky
//! direction.
double displacement(const ExactRay& exact, const Vector3<double>& miss);

//! Where the sky is stretched more than this, it goes around the hole within 1e-4 rad of the
//! screen, a tenth of a pixel. Any sky direction is then close to its correct position, so
//! displacements mean nothing.
inline constexpr double winding_stretch = 1e4;

//! The errors of a method.
struct Misses {
  int wrong = 0;               //!< rays that are bright where they should be dark, or the reverse
  int unresolved = 0;          //!< rays that were reported as not converged
  int improper = 0;            //!< neither a unit vector nor zero, or NaN
  double sky = 0.0;            //!< maximum error on the sky beyond the effect of a direction error of 1e-13 rad [rad]
  std::vector<double> screen;  //!< displacements on the observer's screen where the sky does not wind, sorted [rad]

  [[nodiscard]] double screen_at(double share) const;
};

Misses misses_of(const std::vector<ExactRay>& exact, const SeenSky& seen);

}  // namespace ergodome::test
