#pragma once

#include <optional>

#include "render/passes/stars/refinement/candidate_rays.h"

namespace ergodome {

//! State of one image candidate while it is refined by rays of increasing precision, until it is
//! accepted as an image or rejected.
struct CandidateCourse {
  Vector3<double> begin;          //!< initial direction of the image, from the grid
  RayKind rays = RayKind::quick;  //!< kind of the rays that currently refine it
  int rounds = 0;                 //!< number of Newton steps with this kind of rays
  //! True if the search was restarted at `begin`, because single-precision rays may have gone
  //! astray.
  bool led_away = false;
  // Results of the previous ray of this kind, if any.
  double miss = 0.0;
  //! Smaller singular value of the lens map, with the sign of the image's parity.
  double smaller = 0.0;
  //! Angle between the star and the nearest fold of the lens map, where the sky turns back before
  //! it reaches the star [rad]. It is estimated from two rays; 0 if no fold was found.
  double short_of = 0.0;
};

//! Evaluates the last ray of a candidate and updates its course. Returns the kind of the next ray,
//! or nothing if the candidate is finished. A candidate that is rejected as too faint or beyond a
//! fold gets a `miss` of 1e30 rad; a search in double precision may restart at `course.begin`.
std::optional<RayKind> next_ray(StarCandidate& candidate, CandidateCourse& course, const ImageSearch& search);

}  // namespace ergodome
