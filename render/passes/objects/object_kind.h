#pragma once

#include <string>

#include "render/plan/plan_writer.h"

namespace ergodome {

inline bool needs_polygons(const Show& show, ViewMode mode) {
  return mode == ViewMode::sky && has_objects(show, ObjectMethod::polygon);
}

//! Adds the work of reading the objects' meshes to the plan. Meshes are read for all view modes,
//! because a window can switch between modes.
void plan_mesh_loading(PlanWriter& plan, const std::string& reason);

//! Adds the work for objects that are drawn as polygons to the plan.
void plan_polygons(PlanWriter& plan);

std::unique_ptr<Pass> make_polygon_pass(const PassInput& input);

inline constexpr PassKind polygon_kind = {"polygons",
                                          PassStage::near,
                                          needs_polygons,
                                          plan_polygons,
                                          make_polygon_pass,
                                          /*serves_one_picture=*/false,
                                          /*in_host_memory=*/true};

}  // namespace ergodome
