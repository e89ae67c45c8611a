#include <algorithm>

#include "content/show/animated_show.h"
#include "content/show/stereo_eyes.h"
#include "kernels/eyes/flat/draw_flat_eyes.h"
#include "kernels/near_field/look_up_disk.h"
#include "render/lens/flat/flat_shadow.h"
#include "render/lens/grid/edge_table.h"
#include "render/lens/lens_source.h"
#include "render/passes/disk/disk_grids.h"
#include "render/passes/disk/disk_pass.h"
#include "render/passes/near_field/near_field_kind.h"
#include "render/passes/objects/object_kind.h"
#include "render/passes/shells/shell_pass.h"
#include "render/passes/stars/drawing/blackbody_colours.h"

namespace ergodome {

NearFieldNeeds near_field_needs(const Show& show, ViewMode mode) {
  const bool sky = mode == ViewMode::sky;
  NearFieldNeeds needs{};
  needs.disk = sky && show.disk && show.disk->opacity > 0.0;
  needs.disk_pattern = needs.disk && show.disk->pattern != DiskPattern::none && show.disk->contrast > 0.0;
  needs.shells = (sky || (follows_rays(mode) && !has_camera_per_direction(show.stereo))) &&
                 std::ranges::any_of(show.shells, is_visible);
  needs.traced_objects = sky && has_objects(show, ObjectMethod::trace);
  return needs;
}

namespace {

//! Adds the work for disk, shells and traced objects to the plan: with rays or grids, for one eye
//! and for two.
class NearFieldPlan {
 public:
  explicit NearFieldPlan(PlanWriter& writer)
      : plan_(writer),
        shared_camera_(share_camera(writer.maximum().stereo)),
        needs_(near_field_needs(writer.maximum(), writer.request().mode)),
        always_(near_field_needs(writer.minimum(), writer.request().mode)) {}

  //! Plans disk and shells. Their tables are built for all view modes.
  void plan_disk_and_shells();
  //! Adds one ray per tile, and several rays per pixel for tiles that may see objects.
  void plan_traced_objects(const std::string& objects);

 private:
  //! Returns whether an animation moves an edge of the disk, which may then be empty at times.
  [[nodiscard]] bool disk_edges_move() const;
  [[nodiscard]] bool has_disk_always() const;
  void plan_disk_grid(const std::string& reason, bool if_needed);
  void plan_streamed_disk(const std::string& reason);
  //! Adds the drawing of a disk without shells: from baked layers, or from a grid if that is
  //! cheaper than rays; with rays for pixels that show traced objects.
  void plan_disk_without_shells(DiskDrawing drawing, const std::string& reason, bool if_needed);
  //! Adds the drawing of disk and shells at times when shells are visible (`shells`: one ray per
  //! pixel, whatever the lens of the sky is) or when they are not (plan_disk_without_shells()).
  void plan_near_rays(bool shells);
  //! Adds a pass over all pixels of both eyes, which share a camera.
  void flat_pass(const std::string& name, const std::string& reason, bool if_needed);
  void plan_flat_disk(bool if_needed);
  void plan_flat_near_field();

  PlanWriter& plan_;
  bool shared_camera_;     //!< two eyes share a camera
  NearFieldNeeds needs_;   //!< needs at any time of the show
  NearFieldNeeds always_;  //!< needs at all times of the show
};

bool NearFieldPlan::disk_edges_move() const {
  return find_animation(plan_.maximum(), "disk.outer") != nullptr ||
         find_animation(plan_.maximum(), "hole.spin") != nullptr;
}

bool NearFieldPlan::has_disk_always() const { return always_.disk && !disk_edges_move(); }

void NearFieldPlan::plan_disk_grid(const std::string& reason, bool if_needed) {
  for (const char* const name : {"trace_disk_nodes", "check_disk_cells"}) {
    plan_.pass(name, WorkMoment::position, 0, 0, reason, if_needed);
  }
  for (const char* const name : {"disk grid being traced", "disk grid"}) {
    plan_.buffer(name, WorkMoment::position, 0, reason);
  }
}

void NearFieldPlan::plan_streamed_disk(const std::string& reason) {
  plan_.buffer("disk grid at a position between stations", WorkMoment::picture, 0, reason);
  if (plan_.eyes() > 1) {
    // For an eye beside the camera's path, baked stations are used as long as traced rays confirm
    // them, as for the lens.
    plan_.pass("check_disk_grid", WorkMoment::picture, 0, 0, reason + ", " + plan_.why("stereo.model"), true);
  }
}

void NearFieldPlan::plan_disk_without_shells(DiskDrawing drawing, const std::string& reason, bool if_needed) {
  const bool omni = has_camera_per_direction(plan_.maximum().stereo);
  const bool asked = plan_.request().lens == LensChoice::live;
  const bool may_read =
      may_read_disk_grid(plan_.request().backend, plan_.request().lens, plan_.maximum().grid_scheme) && !omni;
  const bool streamed = may_read && plan_.request().streamed && !asked;
  const bool may_make =
      may_read && (asked || is_worth_a_disk_grid(plan_.request().backend, static_cast<double>(plan_.pixels())));
  if (!streamed && !may_make) {
    return plan_.pixel_pass(near_field_name(drawing, false), reason, if_needed);
  }
  const std::string with_budget = reason + ", " + plan_.why("quality.budget_px");
  if (streamed) {
    plan_streamed_disk(with_budget);
  }
  if (may_make) {
    plan_disk_grid(with_budget, if_needed || streamed || plan_.maximum().disk->plunging);
  }
  // Whether all pictures use the grid. Plunging matter inside the last stable orbit has no grid. A
  // grid that was not requested is not used at positions where it would leave a quarter of the
  // pixels or more to rays.
  const bool certain = asked && !plan_.maximum().disk->plunging;
  plan_.pixel_pass(disk_look_up_name(drawing), with_budget, if_needed || !certain);
  if (needs_.traced_objects) {
    return plan_.pixel_pass(near_field_name(drawing, false), reason + ", " + plan_.why("objects"), if_needed);
  }
  if (!certain) {
    plan_.pixel_pass(near_field_name(drawing, false), reason, true);
  }
}

void NearFieldPlan::plan_near_rays(bool shells) {
  const bool edges_move = disk_edges_move();
  const bool shells_go = needs_.shells != always_.shells;
  const std::string with = ", " + plan_.why("shells");
  const auto disk_pass = [&](DiskDrawing drawing, const std::string& reason, bool if_needed) {
    if (shells) {
      plan_.pixel_pass(near_field_name(drawing, true), reason + with, if_needed);
    } else {
      plan_disk_without_shells(drawing, reason, if_needed);
    }
  };
  if (needs_.disk) {
    const bool pattern = needs_.disk_pattern;
    disk_pass(pattern ? DiskDrawing::pattern : DiskDrawing::plain, plan_.why(pattern ? "disk.pattern" : "disk"),
              edges_move || shells_go || !always_.disk || pattern != always_.disk_pattern || shared_camera_);
  }
  if (needs_.disk_pattern && !always_.disk_pattern) {
    disk_pass(DiskDrawing::plain, plan_.why("disk.contrast"), true);
  }
  if (shells && (!always_.disk || edges_move)) {
    plan_.pixel_pass(near_field_name(DiskDrawing::none, true), plan_.why("shells"),
                     needs_.disk || shells_go || shared_camera_);
  }
}

void NearFieldPlan::flat_pass(const std::string& name, const std::string& reason, bool if_needed) {
  plan_.pass(name, WorkMoment::picture, plan_.shown() * plan_.blocks(), plan_.shown() * plan_.pixels(),
             reason + ", " + plan_.why("stereo.model"), if_needed || plan_.eyes_are_together_at_times());
}

void NearFieldPlan::plan_flat_disk(bool if_needed) {
  const bool asked = plan_.request().lens == LensChoice::live;
  const auto pixels = static_cast<double>(plan_.pixels());
  const bool may_make =
      may_read_disk_grid(plan_.request().backend, plan_.request().lens, plan_.maximum().grid_scheme) &&
      (asked || is_worth_a_disk_grid(plan_.request().backend, pixels));
  // Whether all pictures use the grid, as in plan_disk_without_shells().
  const bool certain = asked && !plan_.maximum().disk->plunging;
  const bool pattern_changes = needs_.disk_pattern != always_.disk_pattern;
  const std::string reason = plan_.why(needs_.disk_pattern ? "disk.pattern" : "disk");
  if (may_make) {
    const std::string with_budget = reason + ", " + plan_.why("quality.budget_px");
    plan_disk_grid(with_budget, if_needed || !certain || plan_.eyes_are_together_at_times());
    for (const bool pattern : {true, false}) {
      if (pattern ? needs_.disk_pattern : !always_.disk_pattern) {
        flat_pass(flat_look_up_name(pattern ? DiskDrawing::pattern : DiskDrawing::plain), with_budget,
                  if_needed || !certain || pattern_changes);
      }
    }
  }
  if (!may_make || !certain || needs_.traced_objects) {
    // Even if the disk has a grid, pixels that show objects need rays.
    flat_pass(flat_eyes_name(DiskDrawing::plain, false),
              needs_.traced_objects ? reason + ", " + plan_.why("objects") : reason,
              if_needed || (may_make && !always_.traced_objects));
  }
}

void NearFieldPlan::plan_flat_near_field() {
  constexpr long positions = FlatShadow::spokes * FlatShadow::depths;
  const bool certain =
      (always_.disk || always_.shells || always_.traced_objects) && !plan_.eyes_are_together_at_times();
  plan_.buffer("flat shadow", WorkMoment::picture, certain ? (edge_points + positions) * long{sizeof(float)} : 0,
               plan_.why("stereo.model"));
  if (!plan_.on_cpu()) {
    plan_.buffer("flat eye's picture", WorkMoment::start, 0, plan_.why("stereo.model"));
  }
  plan_.pass("see_horizon", WorkMoment::picture, certain ? plan_.shown() : 0, certain ? plan_.shown() * positions : 0,
             plan_.why("stereo.model"), !certain);
  const bool disk_goes = needs_.disk && (!always_.disk || disk_edges_move());
  const bool changes = disk_goes || needs_.shells != always_.shells;
  const std::string with_shells = needs_.disk ? plan_.why("disk") + ", " + plan_.why("shells") : plan_.why("shells");
  if (needs_.shells) {
    flat_pass(flat_eyes_name(needs_.disk ? DiskDrawing::plain : DiskDrawing::none, true), with_shells, changes);
    if (disk_goes) {
      flat_pass(flat_eyes_name(DiskDrawing::none, true), plan_.why("shells"), true);
    }
  }
  if (needs_.disk && !always_.shells) {
    plan_flat_disk(changes);
  }
}

void NearFieldPlan::plan_traced_objects(const std::string& objects) {
  plan_.buffer("meshes", WorkMoment::start, 0, objects);
  if (!needs_.traced_objects) {
    return;
  }
  // The number of pixels that see objects is not known in advance.
  if (shared_camera_) {
    plan_.pass("mark_flat_object_tiles", WorkMoment::picture, 0, 0, objects, plan_.eyes_are_together_at_times());
    plan_.pass("look_at_flat_objects", WorkMoment::picture, 0, 0, objects, true);
    if (!has_disk_always() && !always_.shells) {
      flat_pass("lay_objects", objects, needs_.disk || needs_.shells);
    }
  }
  const bool together = !shared_camera_ || plan_.eyes_are_together_at_times();
  if (together) {
    plan_.pass("mark_object_tiles", WorkMoment::picture, 0, 0, objects, shared_camera_);
    plan_.pass("look_at_objects", WorkMoment::picture, 0, 0, objects, true);
    plan_.pass("look_at_objects, slices", WorkMoment::picture, 0, 0, objects, true);
  }
  if (together && !has_disk_always() && !always_.shells) {
    plan_.pixel_pass("lay_objects", objects, needs_.disk || needs_.shells || shared_camera_);
  }
  for (const char* const name : {"objects' tiles", "objects' pixels", "objects' picture"}) {
    plan_.buffer(name, WorkMoment::picture, 0, objects);
  }
  if (has_camera_per_direction(plan_.maximum().stereo)) {
    plan_.buffer("objects' cameras", WorkMoment::picture, 0, plan_.why("stereo.model"));
  }
}

void NearFieldPlan::plan_disk_and_shells() {
  if (plan_.maximum().disk) {
    const bool recoloured = find_animation(plan_.maximum(), "disk.temperature_K") != nullptr;
    plan_.buffer("blackbody table", WorkMoment::start, BlackbodyColours::bytes,
                 plan_.why(recoloured ? "disk.temperature_K" : "disk"));
    plan_.buffer("disk profile", WorkMoment::start, DiskPass::profile_bytes, plan_.why("disk"));
  }
  if (!plan_.maximum().shells.empty()) {
    plan_.buffer("shells", WorkMoment::start, static_cast<long>(plan_.maximum().shells.size()) * ShellPass::shell_bytes,
                 plan_.why("shells"));
    if (std::ranges::any_of(plan_.maximum().shells,
                            [](const ShellSettings& shell) { return !shell.texture.empty(); })) {
      plan_.buffer("shell texture", WorkMoment::start, 0, plan_.why("shells"));
    }
  }
  if (shared_camera_) {
    if (needs_.disk || needs_.shells || needs_.traced_objects) {
      plan_flat_near_field();
    }
    if (!plan_.eyes_are_together_at_times()) {
      return;
    }
  }
  // At times when disk or shells are missing, the others are drawn alone, by another variant of the
  // kernel.
  for (const bool shells : {true, false}) {
    if (shells ? needs_.shells : !always_.shells) {
      plan_near_rays(shells);
    }
  }
}

}  // namespace

void plan_near_field(PlanWriter& plan) {
  NearFieldPlan near_field(plan);
  near_field.plan_disk_and_shells();
  if (has_objects(plan.maximum(), ObjectMethod::trace)) {
    const std::string objects = plan.why("objects");
    plan_mesh_loading(plan, objects);
    near_field.plan_traced_objects(objects);
  }
}

}  // namespace ergodome
