#pragma once

#include "render/plan/plan_writer.h"

namespace ergodome {

//! What the stars of a picture need.
struct StarNeeds {
  bool stars;
  bool gather;  //!< pixels gather their stars
  bool trails;  //!< only while the camera is on its path
  bool spikes;
};

StarNeeds star_needs(const Show& show, ViewMode mode);

//! Plans the stars of a show.
void plan_stars(PlanWriter& plan);

inline constexpr PassKind star_kind = {
    "stars", [](const Show& show, ViewMode mode) { return star_needs(show, mode).stars; }, plan_stars};

}  // namespace ergodome
