#pragma once

#include "render/plan/plan_writer.h"

namespace ergodome {

//! The work that the stars of a picture need.
struct StarNeeds {
  bool stars;
  bool gather;  //!< true if pixels gather their stars (StarMethod::gather)
  bool trails;  //!< true if stars leave trails; only while the camera is on its path
  bool spikes;
};

StarNeeds star_needs(const Show& show, ViewMode mode);

//! Adds the work for a show's stars to the plan.
void plan_stars(PlanWriter& plan);

std::unique_ptr<Pass> make_star_pass(const PassInput& input);

inline constexpr PassKind star_kind = {"stars", PassStage::distant,
                                       [](const Show& show, ViewMode mode) { return star_needs(show, mode).stars; },
                                       plan_stars, make_star_pass};

}  // namespace ergodome
