#pragma once

#include "render/plan/plan_writer.h"

namespace ergodome {

//! Which things near the hole a show's pictures show.
struct NearFieldNeeds {
  bool disk;
  bool disk_pattern;
  bool shells;  //!< any visible shell; heat maps of rays show them as lines
  bool traced_objects;

  [[nodiscard]] bool any() const { return disk || shells || traced_objects; }
};

NearFieldNeeds near_field_needs(const Show& show, ViewMode mode);

//! Adds the work for disk, shells and traced objects to the plan.
void plan_near_field(PlanWriter& plan);

std::unique_ptr<Pass> make_near_field_pass(const PassInput& input);

inline constexpr PassKind near_field_kind = {
    "near_field",
    PassStage::near,
    [](const Show& show, ViewMode mode) { return near_field_needs(show, mode).any(); },
    plan_near_field,
    make_near_field_pass,
    /*serves_one_picture=*/true};

}  // namespace ergodome
