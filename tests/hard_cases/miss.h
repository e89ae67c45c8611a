#pragma once

#include <cmath>

#include "tests/hard_cases/lens_methods.h"

namespace ergodome::test {

inline double length(const Vector3<double>& v) { return std::sqrt(dot(v, v)); }

//! What a ray should have seen, by elliptic functions, and its derivatives, by a Taylor series of
//! order 20.
struct ExactRay {
  bool bright;
  Vector3<double> sky;
  Vector3<double> along[2];  //!< derivatives of the sky along two axes of the camera's sky
  double stretch;            //!< their size: what an error of the direction becomes on the sky
};

std::vector<ExactRay> exact_rays(const CameraStation& camera, const Directions& rays);

//! The displacement on the camera's sky [rad] that makes a small error of the sky direction.
double displacement(const ExactRay& exact, const Vector3<double>& miss);

//! Where the sky is stretched by more than this it goes round the hole within 1e-4 rad of the
//! screen, a tenth of a pixel: whatever the sky, it is next to where it should be, and
//! displacements say nothing.
inline constexpr double winding_stretch = 1e4;

//! By how much a method missed.
struct Misses {
  int wrong = 0;               //!< rays whose light is seen where it is dark, or the other way round
  int unresolved = 0;          //!< rays that said that they did not converge
  int improper = 0;            //!< neither a unit vector nor none, or not a number
  double sky = 0.0;            //!< greatest error on the sky beyond what 1e-13 rad of the direction make [rad]
  std::vector<double> screen;  //!< displacements on the observer's screen where it does not wind, sorted [rad]

  [[nodiscard]] double screen_at(double share) const;
};

Misses misses_of(const std::vector<ExactRay>& exact, const SeenSky& seen);

}  // namespace ergodome::test
