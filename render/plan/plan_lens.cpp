#include <fmt/format.h>

#include "render/lens/grid/edge_table.h"
#include "render/lens/lens_choice.h"
#include "render/plan/planner.h"

namespace ergodome {

std::string Planner::variant(const char* kernel) const {
  return channels_.footprint ? fmt::format("{}, footprints", kernel) : kernel;
}

void Planner::plan_grid(const std::string& reason, bool if_needed) {
  pass("trace_nodes", WorkMoment::place, 0, 0, reason, if_needed);
  pass("check_cells", WorkMoment::place, 0, 0, reason, if_needed);
  buffer("lens grid being traced", WorkMoment::place, 0, reason);
}

void Planner::plan_lens() {
  if (plan_.eyes > 1 && show_.stereo.model == StereoModel::omni) {
    return plan_omni();
  }
  if (follows_rays(request_.mode) && (request_.method || needs_.shells)) {
    return plan_followed();
  }
  const double pixels = static_cast<double>(pixels_);
  const bool asked = request_.lens == LensChoice::live || request_.lens == LensChoice::streamed;
  const std::string quality = why("quality.budget_px");
  if (shows_rays(request_.mode) || request_.lens == LensChoice::direct) {
    return plan_direct(why_view());
  }
  if (show_.grid_scheme == GridScheme::quadtree && request_.backend == Backend::cpu) {
    plan_.lens = "quadtree";
    pass("trace_rays, double", WorkMoment::place, 0, 0, why("grid.scheme"));
    return pixel_pass("read_quadtree_pixels", why("grid.scheme"));
  }
  const bool streamed = request_.streamed && request_.lens != LensChoice::live;
  if (!streamed && !asked && !is_worth_a_grid(request_.backend, pixels)) {
    return plan_direct(why("view.size_px"));
  }
  plan_.lens = streamed ? "streamed" : "live";
  plan_grid(quality, streamed);
  buffer("lens grid", WorkMoment::place, 0, quality);
  pixel_pass(variant("look_up_pixels"), quality, !asked);
  const bool converge = least_.stereo.convergence > 0.0 && least_.stereo.baseline > 0.0;
  if (makes_eyes_in_turn() && !converge) {
    // If both eyes have grids, the grids are read together.
    buffer("second lens channels", WorkMoment::start, 0, why("stereo.layout"));
  }
  if (!asked) {
    // Used where a grid would leave most pixels to rays.
    pixel_pass(variant("trace_pixels"), quality, true);
  }
  if (streamed) {
    buffer("lens grid at a position between stations", WorkMoment::picture, 0, quality);
    if (plan_.eyes > 1) {
      // Stations serve an eye beside the camera's path as long as traced rays confirm them.
      pass("check_blend", WorkMoment::picture, 0, 0, quality + ", " + why("stereo.model"), true);
    }
  }
  buffer("shadow edge", WorkMoment::picture, 0, quality);
}

void Planner::plan_direct(const std::string& reason) {
  plan_.lens = "direct";
  pixel_pass(variant("trace_pixels"), reason);
  buffer("shadow edge", WorkMoment::picture, plan_.eyes * edge_points * static_cast<long>(sizeof(float)), reason);
}

void Planner::plan_followed() {
  const bool always = request_.method || always_.shells;
  const std::string reason = needs_.shells ? why_view() + ", " + why("shells") : why_view();
  plan_.lens = "direct";
  pixel_pass("follow_rays", reason, !always);
  if (!always) {
    pixel_pass("trace_pixels", why_view(), true);
    buffer("shadow edge", WorkMoment::picture, 0, why_view());
  }
}

void Planner::plan_omni() {
  const std::string model = why("stereo.model");
  const bool asked = request_.lens == LensChoice::live || request_.lens == LensChoice::streamed;
  const bool traced = request_.backend != Backend::cpu || request_.lens == LensChoice::direct ||
                      shows_rays(request_.mode) ||
                      (!asked && !is_worth_a_grid(request_.backend, static_cast<double>(pixels_)));
  buffer("omni cameras", WorkMoment::picture, 0, model);
  plan_.lens = traced ? "direct" : "live";
  if (traced) {
    pixel_pass(variant("trace_omni_pixels"), model);
    return buffer("shadow edge", WorkMoment::picture, plan_.eyes * edge_points * static_cast<long>(sizeof(float)),
                  model);
  }
  plan_grid(model, !asked);
  buffer("lens grid", WorkMoment::place, 0, model);
  pixel_pass(variant("look_up_omni_pixels"), model, !asked);
  if (!asked) {
    // Used where a grid would leave most pixels to rays or would need double precision.
    pixel_pass(variant("trace_omni_pixels"), model, true);
    buffer("shadow edge", WorkMoment::picture, 0, model);
  }
}

}  // namespace ergodome
