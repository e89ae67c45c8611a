#pragma once

#include "render/plan/plan_writer.h"

namespace ergodome {

inline bool needs_bloom(const Show& show, ViewMode mode) {
  const std::optional<BloomSettings>& bloom = show.effects.bloom;
  return mode == ViewMode::sky && bloom && bloom->strength > 0.0 && bloom->radius_px > 0.0;
}

void plan_bloom(PlanWriter& plan);
std::unique_ptr<Pass> make_bloom_pass(const PassInput& input);

//! Spreads light over finished pictures.
inline constexpr PassKind bloom_kind = {"bloom",
                                        PassStage::finished,
                                        needs_bloom,
                                        plan_bloom,
                                        make_bloom_pass,
                                        /*serves_one_picture=*/false,
                                        /*in_host_memory=*/true};

}  // namespace ergodome
