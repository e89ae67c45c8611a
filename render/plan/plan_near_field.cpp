#include <algorithm>

#include "content/show/animated_show.h"
#include "render/passes/disk/disk_grids.h"
#include "render/passes/disk/disk_pass.h"
#include "render/passes/shells/shell_pass.h"
#include "render/passes/stars/drawing/blackbody_colours.h"
#include "render/plan/planner.h"

namespace ergodome {

void Planner::plan_near_field() {
  if (show_.disk) {
    const bool recoloured = find_animation(show_, "disk.temperature_K") != nullptr;
    buffer("blackbody table", WorkMoment::start, BlackbodyColours::bytes,
           why(recoloured ? "disk.temperature_K" : "disk"));
    buffer("disk profile", WorkMoment::start, DiskPass::profile_bytes, why("disk"));
  }
  if (!show_.shells.empty()) {
    buffer("shells", WorkMoment::start, static_cast<long>(show_.shells.size()) * ShellPass::shell_bytes, why("shells"));
    if (std::ranges::any_of(show_.shells, [](const ShellSettings& shell) { return !shell.texture.empty(); })) {
      buffer("shell texture", WorkMoment::start, 0, why("shells"));
    }
  }
  if (eyes_are_flat()) {
    if (needs_.disk || needs_.shells || needs_.traced_objects) {
      plan_flat_near_field();
    }
    if (!eyes_are_together_at_times()) {
      return;
    }
  }
  // If one part is missing at times, the other is drawn alone then.
  for (const bool shells : {true, false}) {
    if (shells ? needs_.shells : !always_.shells) {
      plan_near_rays(shells);
    }
  }
}

bool Planner::has_disk_always() const { return always_.disk && !disk_edges_move(); }

bool Planner::disk_edges_move() const {
  return find_animation(show_, "disk.outer") != nullptr || find_animation(show_, "hole.spin") != nullptr;
}

void Planner::plan_near_rays(bool shells) {
  const bool edges_move = disk_edges_move();
  const bool shells_go = needs_.shells != always_.shells;
  const std::string with = ", " + why("shells");
  const auto disk_pass = [&](DiskDrawing drawing, const std::string& reason, bool if_needed) {
    if (shells) {
      pixel_pass(near_field_name(drawing, true), reason + with, if_needed);
    } else {
      plan_disk_without_shells(drawing, reason, if_needed);
    }
  };
  if (needs_.disk) {
    const bool pattern = needs_.disk_pattern;
    disk_pass(pattern ? DiskDrawing::pattern : DiskDrawing::plain, why(pattern ? "disk.pattern" : "disk"),
              edges_move || shells_go || !always_.disk || pattern != always_.disk_pattern || eyes_are_flat());
  }
  if (needs_.disk_pattern && !always_.disk_pattern) {
    disk_pass(DiskDrawing::plain, why("disk.contrast"), true);
  }
  if (shells && (!always_.disk || edges_move)) {
    pixel_pass(near_field_name(DiskDrawing::none, true), why("shells"), needs_.disk || shells_go || eyes_are_flat());
  }
}

void Planner::plan_disk_without_shells(DiskDrawing drawing, const std::string& reason, bool if_needed) {
  const bool omni = plan_.eyes > 1 && show_.stereo.model == StereoModel::omni;
  const bool asked = request_.lens == LensChoice::live;
  const bool may_read = may_read_disk_grid(request_.backend, request_.lens, show_.grid_scheme) && !omni;
  const bool streamed = may_read && request_.streamed && !asked;
  const bool may_make = may_read && (asked || is_worth_a_disk_grid(request_.backend, static_cast<double>(pixels_)));
  if (!streamed && !may_make) {
    return pixel_pass(near_field_name(drawing, false), reason, if_needed);
  }
  const std::string with_budget = reason + ", " + why("quality.budget_px");
  if (streamed) {
    plan_streamed_disk(with_budget);
  }
  if (may_make) {
    plan_disk_grid(with_budget, if_needed || streamed || show_.disk->plunging);
  }
  // Matter that falls from the last stable orbit has no grid. For other disks the grid leaves most
  // pixels to rays at some positions.
  const bool certain = asked && !show_.disk->plunging;
  pixel_pass(disk_look_up_name(drawing), with_budget, if_needed || !certain);
  if (needs_.traced_objects) {
    return pixel_pass(near_field_name(drawing, false), reason + ", " + why("objects"), if_needed);
  }
  if (!certain) {
    pixel_pass(near_field_name(drawing, false), reason, true);
  }
}

void Planner::plan_disk_grid(const std::string& reason, bool if_needed) {
  for (const char* const name : {"trace_disk_nodes", "check_disk_cells"}) {
    pass(name, WorkMoment::place, 0, 0, reason, if_needed);
  }
  for (const char* const name : {"disk grid being traced", "disk grid"}) {
    buffer(name, WorkMoment::place, 0, reason);
  }
}

void Planner::plan_streamed_disk(const std::string& reason) {
  buffer("disk grid at a position between stations", WorkMoment::picture, 0, reason);
  if (plan_.eyes > 1) {
    // As for the lens, stations serve an eye beside the camera's path as long as traced rays
    // confirm them.
    pass("check_disk_grid", WorkMoment::picture, 0, 0, reason + ", " + why("stereo.model"), true);
  }
}

void Planner::plan_traced_objects(const std::string& objects) {
  buffer("meshes", WorkMoment::start, 0, objects);
  if (!needs_.traced_objects) {
    return;
  }
  // The number of these pixels is not known in advance.
  if (eyes_are_flat()) {
    pass("mark_flat_object_tiles", WorkMoment::picture, 0, 0, objects, eyes_are_together_at_times());
    pass("look_at_flat_objects", WorkMoment::picture, 0, 0, objects, true);
    if (!has_disk_always() && !always_.shells) {
      flat_pass("lay_objects", objects, needs_.disk || needs_.shells);
    }
  }
  const bool together = !eyes_are_flat() || eyes_are_together_at_times();
  if (together) {
    pass("mark_object_tiles", WorkMoment::picture, 0, 0, objects, eyes_are_flat());
    pass("look_at_objects", WorkMoment::picture, 0, 0, objects, true);
    pass("look_at_objects, slices", WorkMoment::picture, 0, 0, objects, true);
  }
  if (together && !has_disk_always() && !always_.shells) {
    pixel_pass("lay_objects", objects, needs_.disk || needs_.shells || eyes_are_flat());
  }
  for (const char* const name : {"objects' tiles", "objects' pixels", "objects' picture"}) {
    buffer(name, WorkMoment::picture, 0, objects);
  }
  if (plan_.eyes > 1 && show_.stereo.model == StereoModel::omni) {
    buffer("objects' cameras", WorkMoment::picture, 0, why("stereo.model"));
  }
}

void Planner::plan_objects() {
  if (show_.objects.empty()) {
    return;
  }
  const std::string objects = why("objects");
  pass("load_meshes", WorkMoment::start, 1, static_cast<long>(show_.objects.size()), objects);
  if (has_objects(show_, ObjectMethod::trace)) {
    return plan_traced_objects(objects);
  }
  pass("open_gl", WorkMoment::start, 1, 1, objects);
  buffer("meshes", WorkMoment::start, request_.mesh_bytes, objects);
  if (!needs_.objects) {
    return;
  }
  const bool lit = std::ranges::any_of(show_.objects, &ObjectSettings::lit);
  const std::string tables = lit ? objects + ", " + why("light") : objects;
  pass("make_connection_table", WorkMoment::place, 0, 0, tables);
  buffer("connecting rays", WorkMoment::place, 0, tables);
  // Eyes that share a lens have one picture, but see objects from their own positions.
  const long eyes = eyes_are_flat() ? shown_ : plan_.eyes;
  const bool known = !eyes_are_flat() || !eyes_are_together_at_times();
  pass("draw_objects", WorkMoment::picture, known ? eyes : 0, known ? eyes * pixels_ : 0, objects);
  buffer("objects' picture", WorkMoment::start, 0, objects);
}

}  // namespace ergodome
