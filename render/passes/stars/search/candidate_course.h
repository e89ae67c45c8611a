#pragma once

#include <optional>

#include "render/passes/stars/search/candidate_rays.h"

namespace ergodome {

//! What one candidate goes through: rays of one kind after the other, until it is an image or there is none.
struct CandidateCourse {
  Vector3<double> begin;          //!< direction from the grid
  RayKind rays = RayKind::quick;  //!< that it is followed by
  int rounds = 0;                 //!< of these it has had
  bool led_away = false;          //!< it began anew where the grid has it
  // What its last ray of this kind said, where it had one.
  double miss = 0.0;
  double smaller = 0.0;  //!< singular value, with the sign of the parity
  //! How far from its star the sky is folded back, as its last two rays had it; 0: they had it nowhere [rad].
  double short_of = 0.0;
};

//! Takes the ray into account that a candidate was followed by last; the kind of the next one, or nothing where it has come to its end.
std::optional<RayKind> go_on(StarCandidate& candidate, CandidateCourse& course, const ImageSearch& search);

}  // namespace ergodome
