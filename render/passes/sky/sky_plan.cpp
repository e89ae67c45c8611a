#include "kernels/lens/tile_shading.h"
#include "render/passes/near_field/near_field_kind.h"
#include "render/passes/sky/column_sums.h"
#include "render/passes/sky/lens_plan.h"
#include "render/passes/sky/sky_cube.h"
#include "render/passes/sky/sky_kind.h"
#include "render/passes/stars/drawing/blackbody_colours.h"

namespace ergodome {

namespace {

void plan_channels(PlanWriter& plan, const LensChannels& channels, const SkyShading& shading) {
  const auto channel = [&](bool wanted, const char* name, int floats, const std::string& reason) {
    if (wanted) {
      plan.channel(name, floats, reason);
    }
  };
  const bool sky = plan.request().mode == ViewMode::sky;
  channel(true, "coverage", 1, "every picture shows the shadow");
  channel(true, "error_estimate", 1, "the failed rays of every picture are counted");
  channel(channels.sky, "sky", 3, plan.why_view());
  channel(channels.footprint, "footprint", 6,
          sky ? plan.why(shading.brightening ? "sky.brightening" : "sky.filter") : plan.why_view());
  channel(channels.frequency_ratio, "frequency_ratio", 1, sky ? plan.why("effects.redshift") : plan.why_view());
  channel(channels.steps, "steps", 1, plan.why_view());
  channel(channels.half_orbits, "half_orbits", 1, plan.why_view());
  const long block = static_cast<long>(plan.block_rows()) * plan.width_px();
  constexpr long float_bytes = sizeof(float);
  plan.buffer("lens channels", WorkMoment::start, channels.floats() * block * float_bytes, "the channels above");
  if (!plan.on_cpu()) {
    // On the CPU, light is written directly into the finished picture, which is counted here.
    plan.buffer("picture", WorkMoment::start, 4 * block * float_bytes, plan.why("view.size_px"));
  }
  plan.buffer("finished picture", WorkMoment::picture, plan.eyes() * 4 * plan.pixels() * float_bytes,
              plan.why("view.size_px"));
}

//! Adds the sky map to the plan, in the form that its filter reads.
void plan_map(PlanWriter& plan, const SkyShading& shading) {
  const bool polygons = shading.filter == SkyFilter::polygon;
  const bool fitted = shading.shift == SkyShift::blackbody_fit;
  const int width = plan.request().map_width_px;
  const auto sky_buffer = [&](const char* name, long bytes, const std::string& reason) {
    plan.buffer(name, plan.sky_turns() ? WorkMoment::picture : WorkMoment::start, plan.sky_turns() ? 0 : bytes,
                plan.sky_turns() ? reason + ", " + plan.why("sky.spin_axis") : reason);
  };
  sky_buffer("sky map", static_cast<long>(SkyCube::bytes_for(polygons ? 1 : width)), plan.why("sky.map"));
  if (polygons) {
    sky_buffer("column sums", ColumnSums::bytes_for(width, fitted), plan.why("sky.filter"));
  }
  if (fitted) {
    // There are two tables: one to fit temperatures, one for the kernels.
    sky_buffer("blackbody table", 2 * BlackbodyColours::bytes, plan.why("sky.shift"));
  }
}

void plan_shading(PlanWriter& plan, const SkyShading& shading, ShadedByLens by_lens) {
  plan_map(plan, shading);
  if (plan.request().mode != ViewMode::sky) {
    return plan.pixel_pass("shade_heat_map", plan.why_view());
  }
  if (shading.filter == SkyFilter::polygon) {
    plan.pixel_pass("filter_polygons", plan.why("sky.filter"));
  }
  std::string reason = plan.why("sky.filter");
  if (shading.shift != SkyShift::none) {
    reason += ", " + plan.why("effects.redshift");
  }
  if (shading.brightening) {
    reason += ", " + plan.why("sky.brightening");
  }
  if (by_lens != ShadedByLens::never) {
    plan.pixel_pass(tile_shading_name(shading.filter, shading.shift), plan.why("quality.budget_px") + ", " + reason,
                    by_lens == ShadedByLens::possibly);
  }
  if (by_lens != ShadedByLens::always) {
    plan.pixel_pass(shading_name(shading.filter, shading.shift, shading.brightening), reason,
                    by_lens == ShadedByLens::possibly);
  }
}

}  // namespace

void plan_sky(PlanWriter& plan) {
  const SkyShading shading = shading_of(plan.maximum());
  const LensChannels channels = lens_channels(plan.request().mode, shading);
  plan_channels(plan, channels, shading);
  const auto follows_shells = [&](const Show& show) { return near_field_needs(show, plan.request().mode).shells; };
  const ShadedByLens by_lens =
      plan_lens(plan, shading, {follows_shells(plan.maximum()), follows_shells(plan.minimum())});
  plan_shading(plan, shading, by_lens);
}

}  // namespace ergodome
