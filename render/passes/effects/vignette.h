#pragma once

#include "render/plan/plan_writer.h"

namespace ergodome {

inline bool needs_vignette(const Show& show, ViewMode mode) {
  const ViewProjection projection = show.view.projection;
  return mode == ViewMode::sky && show.view.vignette > 0.0 &&
         (projection == ViewProjection::dome || projection == ViewProjection::pinhole);
}

//! Returns the fraction of the light that remains at a distance from the picture's center; the
//! distance is in half widths along x and half heights along y. The fraction is 1 up to a distance
//! of 0.5, and 1 - `strength` from a distance of 1 on.
double vignette_light(double strength, double distance);

void plan_vignette(PlanWriter& plan);
std::unique_ptr<Pass> make_vignette_pass(const PassInput& input);

//! Darkens finished pictures toward their edge, so that the edge does not distract in a headset.
inline constexpr PassKind vignette_kind = {"vignette",
                                           PassStage::finished,
                                           needs_vignette,
                                           plan_vignette,
                                           make_vignette_pass,
                                           /*serves_one_picture=*/false,
                                           /*in_host_memory=*/true};

}  // namespace ergodome
