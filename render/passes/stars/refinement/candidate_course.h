#pragma once

#include <optional>

#include "render/passes/stars/refinement/candidate_rays.h"

namespace ergodome {

//! State of one candidate as it is refined by rays of increasing precision, until it is found to be
//! an image or not.
struct CandidateCourse {
  Vector3<double> begin;          //!< initial direction, from the grid
  RayKind rays = RayKind::quick;  //!< kind of its current rays
  int rounds = 0;                 //!< number of rounds with this kind
  bool led_away = false;          //!< whether it was restarted at `begin`
  // Results of the previous ray of this kind, if any.
  double miss = 0.0;
  double smaller = 0.0;  //!< smaller singular value, signed by parity
  //! Distance from the star to the fold before it, estimated by the last two rays; 0: no fold was
  //! found [rad].
  double short_of = 0.0;
};

//! Evaluates the last ray of a candidate. Returns the kind of the next ray, or nothing if the
//! candidate is finished.
std::optional<RayKind> go_on(StarCandidate& candidate, CandidateCourse& course, const ImageSearch& search);

}  // namespace ergodome
