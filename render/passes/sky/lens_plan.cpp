#include "render/passes/sky/lens_plan.h"

#include <fmt/format.h>

#include "content/show/stereo_eyes.h"
#include "kernels/lens/tile_shading.h"
#include "render/lens/grid/edge_table.h"
#include "render/lens/lens_source.h"

namespace ergodome {

namespace {

//! Returns the name of the variant of a kernel that computes the given channels.
std::string variant(const LensChannels& channels, const char* kernel) {
  return channels.footprint ? fmt::format("{}, footprints", kernel) : kernel;
}

void plan_direct(PlanWriter& plan, const LensChannels& channels, const std::string& reason) {
  plan.set_lens("direct");
  plan.pixel_pass(variant(channels, "trace_pixels"), reason);
  plan.buffer("shadow edge", WorkMoment::picture, plan.eyes() * edge_points * static_cast<long>(sizeof(float)), reason);
}

//! Adds the rays of heat maps that are traced with one integrator, or to shells, to the plan.
void plan_followed(PlanWriter& plan, const ShellsFollowed& shells) {
  const bool always = plan.request().method || shells.always;
  const std::string reason = shells.at_most ? plan.why_view() + ", " + plan.why("shells") : plan.why_view();
  plan.set_lens("direct");
  plan.pixel_pass("follow_rays", reason, !always);
  if (!always) {
    plan.pixel_pass("trace_pixels", plan.why_view(), true);
    plan.buffer("shadow edge", WorkMoment::picture, 0, plan.why_view());
  }
}

//! Adds the lenses that OmniChooser may choose to the plan.
void plan_omni(PlanWriter& plan, const LensChannels& channels) {
  const std::string model = plan.why("stereo.model");
  const bool asked = plan.request().lens == LensChoice::live || plan.request().lens == LensChoice::streamed;
  const bool traced = !plan.on_cpu() || plan.request().lens == LensChoice::direct || shows_rays(plan.request().mode) ||
                      (!asked && !is_worth_a_grid(plan.request().backend, static_cast<double>(plan.pixels()), true));
  plan.buffer("omni cameras", WorkMoment::picture, 0, model);
  plan.set_lens(traced ? "direct" : "live");
  if (traced) {
    plan.pixel_pass(variant(channels, "trace_omni_pixels"), model);
    return plan.buffer("shadow edge", WorkMoment::picture, plan.eyes() * edge_points * static_cast<long>(sizeof(float)),
                       model);
  }
  plan_grid(plan, model, !asked);
  plan.buffer("lens grid", WorkMoment::position, 0, model);
  plan.pixel_pass(variant(channels, "look_up_omni_pixels"), model, !asked);
  if (!asked) {
    // Rays are used if a grid would leave a quarter of the pixels or more to rays, or would need
    // double precision.
    plan.pixel_pass(variant(channels, "trace_omni_pixels"), model, true);
    plan.buffer("shadow edge", WorkMoment::picture, 0, model);
  }
}

}  // namespace

void plan_grid(PlanWriter& plan, const std::string& reason, bool if_needed) {
  plan.pass("trace_nodes", WorkMoment::position, 0, 0, reason, if_needed);
  plan.pass("check_cells", WorkMoment::position, 0, 0, reason, if_needed);
  plan.buffer("lens grid being traced", WorkMoment::position, 0, reason);
}

ShadedByLens plan_lens(PlanWriter& plan, const SkyShading& shading, const ShellsFollowed& shells) {
  const LensChannels channels = lens_channels(plan.request().mode, shading);
  if (has_camera_per_direction(plan.maximum().stereo)) {
    plan_omni(plan, channels);
    return ShadedByLens::never;
  }
  if (follows_rays(plan.request().mode) && (plan.request().method || shells.at_most)) {
    plan_followed(plan, shells);
    return ShadedByLens::never;
  }
  const double pixels = static_cast<double>(plan.pixels());
  const bool asked = plan.request().lens == LensChoice::live || plan.request().lens == LensChoice::streamed;
  const std::string quality = plan.why("quality.budget_px");
  if (shows_rays(plan.request().mode) || plan.request().lens == LensChoice::direct) {
    plan_direct(plan, channels, plan.why_view());
    return ShadedByLens::never;
  }
  if (plan.maximum().grid_scheme == GridScheme::quadtree && plan.on_cpu()) {
    plan.set_lens("quadtree");
    plan.pass("trace_rays, double", WorkMoment::position, 0, 0, plan.why("grid.scheme"));
    plan.pixel_pass("read_quadtree_pixels", plan.why("grid.scheme"));
    return ShadedByLens::never;
  }
  const bool streamed = plan.request().streamed && plan.request().lens != LensChoice::live;
  if (!streamed && !asked && !is_worth_a_grid(plan.request().backend, pixels)) {
    plan_direct(plan, channels, plan.why("view.size_px"));
    return ShadedByLens::never;
  }
  plan.set_lens(streamed ? "streamed" : "live");
  plan_grid(plan, quality, streamed);
  plan.buffer("lens grid", WorkMoment::position, 0, quality);
  const bool on_tiles = plan.on_cpu() && shades_on_tiles(plan.request().mode, shading.filter, shading.brightening);
  if (!on_tiles) {
    plan.pixel_pass(variant(channels, plan.on_cpu() ? "look_up_tiles" : "look_up_pixels"), quality, !asked);
  }
  if (!asked) {
    // Rays are used if a grid would leave a quarter of the pixels or more to rays.
    plan.pixel_pass(variant(channels, "trace_pixels"), quality, true);
  }
  if (streamed) {
    plan.buffer("lens grid at a position between stations", WorkMoment::picture, 0, quality);
    if (plan.eyes() > 1) {
      // For an eye beside the camera's path, stations are used as long as traced rays confirm them.
      plan.pass("check_blend", WorkMoment::picture, 0, 0, quality + ", " + plan.why("stereo.model"), true);
    }
  }
  plan.buffer("shadow edge", WorkMoment::picture, 0, quality);
  if (!on_tiles) {
    return ShadedByLens::never;
  }
  return asked ? ShadedByLens::always : ShadedByLens::possibly;
}

}  // namespace ergodome
