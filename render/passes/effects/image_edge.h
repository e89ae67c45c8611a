#pragma once

#include "render/passes/effects/bloom_pass.h"
#include "render/passes/effects/diffraction.h"

namespace ergodome {

//! Returns whether effects may spread light beyond the edge of the image.
inline bool spreads_beyond_image(const Show& show, ViewMode mode) {
  return needs_bloom(show, mode) || shows_spikes(show, mode);
}

void plan_image_edge(PlanWriter& plan);
std::unique_ptr<Pass> make_image_edge_pass(const PassInput& input);

//! Blackens pixels outside the image, because halos and spikes extend beyond its edge.
inline constexpr PassKind image_edge_kind = {"image_edge", PassStage::finished, spreads_beyond_image, plan_image_edge,
                                             make_image_edge_pass};

}  // namespace ergodome
