#include "content/show/animated_show.h"
#include "render/passes/sky/column_sums.h"
#include "render/passes/sky/sky_cube.h"
#include "render/passes/stars/drawing/blackbody_colours.h"
#include "render/plan/planner.h"

namespace ergodome {

void Planner::plan_shading() {
  const SkyShading& shading = needs_.shading;
  plan_map(shading);
  if (request_.mode != ViewMode::sky) {
    return pixel_pass("shade_heat_map", why_view());
  }
  if (shading.filter == SkyFilter::polygon) {
    pixel_pass("filter_polygons", why("sky.filter"));
  }
  std::string reason = why("sky.filter");
  if (shading.shift != SkyShift::none) {
    reason += ", " + why("effects.redshift");
  }
  if (shading.brightening) {
    reason += ", " + why("sky.brightening");
  }
  pixel_pass(shading_name(shading.filter, shading.shift, shading.brightening), reason);
}

void Planner::plan_map(const SkyShading& shading) {
  const bool polygons = shading.filter == SkyFilter::polygon;
  const bool fitted = shading.shift == SkyShift::blackbody_fit;
  const int width = request_.map_width_px;
  const auto sky_buffer = [&](const char* name, long bytes, const std::string& reason) {
    buffer(name, sky_turns() ? WorkMoment::picture : WorkMoment::start, sky_turns() ? 0 : bytes,
           sky_turns() ? reason + ", " + why("sky.spin_axis") : reason);
  };
  sky_buffer("sky map", static_cast<long>(SkyCube::bytes_for(polygons ? 1 : width)), why("sky.map"));
  if (polygons) {
    sky_buffer("column sums", ColumnSums::bytes_for(width, fitted), why("sky.filter"));
  }
  if (fitted) {
    // One table to fit temperatures, one for the kernels.
    sky_buffer("blackbody table", 2 * BlackbodyColours::bytes, why("sky.shift"));
  }
}

void Planner::plan_star_loading() {
  const bool turns = sky_turns();
  const std::string stars = why("sky.stars") + (turns ? ", " + why("sky.spin_axis") : "");
  const WorkMoment moment = turns ? WorkMoment::picture : WorkMoment::start;
  pass("load_stars", moment, turns ? 0 : 1, 0, stars, turns);
  buffer("blackbody table", moment, turns ? 0 : BlackbodyColours::bytes, stars);
  if (frame_needs(show_, ViewMode::sky).spikes) {
    const bool changes = find_animation(show_, "effects.diffraction.obstruction") != nullptr ||
                         find_animation(show_, "effects.diffraction.scale") != nullptr;
    buffer("diffraction pattern", turns || changes ? WorkMoment::picture : WorkMoment::start, 0,
           why("effects.diffraction"));
  }
}

void Planner::plan_stars() {
  const std::string stars = why("sky.stars");
  if (needs_.gather) {
    pass("gather_stars", WorkMoment::picture, plan_.eyes * gathers_, plan_.eyes * gathered_pixels_,
         why("stars.method"));
    pass("trace_rays, double", WorkMoment::picture, 0, 0, why("stars.method"));
  } else {
    plan_grid(stars, false);
    buffer("shadow edge", WorkMoment::place, 0, stars);
    // Not needed if the previous picture had the same camera, even slightly turned. Eyes that see
    // the same share the result.
    const bool may_share = plan_.eyes > 1 && (eyes_are_flat() || eyes_are_together_at_times());
    pass("search_patches", WorkMoment::picture, may_share ? 0 : plan_.eyes, 0, stars, true);
    pass("find_star_images", WorkMoment::picture, 0, 0, stars, true);
    pass("find_star_images, double", WorkMoment::picture, 0, 0, stars, true);
  }
  if (needs_.trails) {
    pass("follow_trails", WorkMoment::picture, plan_.eyes, 0, why("effects.trails"), !always_.trails);
    if (needs_.gather) {
      pass("find_star_images", WorkMoment::picture, 0, 0, why("effects.trails"), true);
      pass("find_star_images, double", WorkMoment::picture, 0, 0, why("effects.trails"), true);
    }
  }
  if (request_.backend != Backend::cpu) {
    // Stars are searched for and drawn in the memory of the picture.
    if (!needs_.gather) {
      buffer("star search", WorkMoment::start, 0, stars);
      buffer("star images", WorkMoment::picture, 0, stars);
      pass("place_star_images", WorkMoment::picture, 0, 0, stars, true);
    }
    buffer("star points", WorkMoment::picture, 0, stars);
    buffer("star tiles", WorkMoment::picture, 0, stars);
    if (needs_.spikes) {
      buffer("diffraction pattern, placed", WorkMoment::picture, 0, why("effects.diffraction"));
    }
  }
  pass("splat_stars", WorkMoment::picture, plan_.eyes * blocks_, 0, stars, true);
  if (needs_.spikes) {
    pass("draw_spikes", WorkMoment::picture, plan_.eyes * blocks_, 0, why("effects.diffraction"), true);
  }
}

void Planner::plan_light() {
  if (eyes_are_flat()) {
    const bool at_times = eyes_are_together_at_times();
    pass("trace_affine_distances", WorkMoment::picture, 1, 0, why("stereo.model"), at_times);
    pass("mask_shadow", WorkMoment::picture, shown_, shown_ * pixels_, why("stereo.baseline"), at_times);
  }
  if (needs_.bloom) {
    pass("add_bloom", WorkMoment::picture, shown_, shown_ * pixels_, why("effects.bloom"), !always_.bloom);
  }
  if (needs_.clear_outside) {
    pass("clear_outside", WorkMoment::picture, shown_, shown_ * pixels_,
         why(needs_.bloom ? "effects.bloom" : "effects.diffraction"), !always_.clear_outside);
  }
  if (needs_.auto_exposure) {
    pass("meter_light", WorkMoment::picture, shown_, shown_ * pixels_, why("tone.auto"));
  }
  plan_overlays();
}

void Planner::plan_overlays() {
  const Timeline& timeline = show_.timeline;
  if (!timeline.overlays.empty()) {
    buffer("overlay images", WorkMoment::start, request_.overlay_bytes, why("overlay"));
  }
  const bool words = !timeline.captions.empty() || show_.readout;
  if (request_.mode != ViewMode::sky || (timeline.overlays.empty() && !words)) {
    return;
  }
  std::string of_words = timeline.captions.empty() ? "" : why("caption");
  of_words += show_.readout ? (of_words.empty() ? "" : ", ") + why("readout") : "";
  if (words) {
    pass("set_captions", WorkMoment::start, 0, 0, of_words, true);
    buffer("captions", WorkMoment::start, 0, of_words);
  }
  std::string shown = timeline.overlays.empty() ? "" : why("overlay");
  shown += words ? (shown.empty() ? "" : ", ") + of_words : "";
  pass("draw_overlay", WorkMoment::picture, 0, 0, shown, true);
}

}  // namespace ergodome
