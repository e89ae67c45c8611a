#pragma once

#include <cmath>

#include "tests/hard_cases/lens_methods.h"

// Exact rays, and the errors of a method as compared with them.
namespace ergodome::test {

inline double length(const Vector3<double>& v) { return std::sqrt(dot(v, v)); }

//! The exact end of a ray. The sky direction is computed by elliptic functions, its derivatives by
//! the direction of the ray from a Taylor series of order 20.
struct ExactRay {
  bool bright;
  Vector3<double> sky;
  //! Derivatives of `sky` along two perpendicular axes of the camera's sky [per rad].
  Vector3<double> along[2];
  //! Sum of the lengths of both derivatives. By up to this factor, an error of the observed
  //! direction is amplified on the sky.
  double stretch;
};

std::vector<ExactRay> exact_rays(const CameraStation& camera, const Directions& rays);

//! Converts a small error of the sky direction, `miss`, to the displacement on the camera's sky
//! that would cause it [rad].
double displacement(const ExactRay& exact, const Vector3<double>& miss);

//! Where the lens stretches the sky by more than this factor, the sky goes around the hole within
//! 1e-4 rad of the screen, a tenth of a pixel. There any sky direction is close to its correct
//! position, so displacements mean nothing.
inline constexpr double winding_stretch = 1e4;

//! The errors of a method for the rays of a case.
struct Misses {
  int wrong = 0;       //!< rays that are bright where they should be dark, or the reverse
  int unresolved = 0;  //!< rays that were reported as not converged
  //! Rays whose sky direction is neither a unit vector nor zero.
  int improper = 0;
  //! Maximum error of the sky direction, in excess of what an error of the observed direction of
  //! 1e-13 rad would cause [rad].
  double sky = 0.0;
  //! Displacements of the rays' directions on the observer's screen, sorted [rad]; without those
  //! where the sky winds around the hole.
  std::vector<double> screen;

  [[nodiscard]] double screen_at(double share) const;
};

Misses misses_of(const std::vector<ExactRay>& exact, const SeenSky& seen);

}  // namespace ergodome::test
