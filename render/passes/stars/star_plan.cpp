#include "content/show/animated_show.h"
#include "content/show/stereo_eyes.h"
#include "render/passes/effects/diffraction.h"
#include "render/passes/sky/lens_plan.h"
#include "render/passes/stars/drawing/blackbody_colours.h"
#include "render/passes/stars/drawing/picture_regions.h"
#include "render/passes/stars/star_kind.h"

namespace ergodome {

StarNeeds star_needs(const Show& show, ViewMode mode) {
  const bool stars = mode == ViewMode::sky && !show.sky.stars.empty();
  const std::optional<TrailSettings>& trails = show.effects.trails;
  return {stars, stars && show.sky.star_method == StarMethod::gather, stars && trails && trails->shutter_s > 0.0,
          shows_spikes(show, mode)};
}

namespace {

//! Adds the loading of the catalog, for all view modes, because a window can switch between modes.
void plan_star_loading(PlanWriter& plan) {
  const bool turns = plan.sky_turns();
  const std::string stars = plan.why("sky.stars") + (turns ? ", " + plan.why("sky.spin_axis") : "");
  const WorkMoment moment = turns ? WorkMoment::picture : WorkMoment::start;
  plan.pass("load_stars", moment, turns ? 0 : 1, 0, stars, turns);
  plan.buffer("blackbody table", moment, turns ? 0 : BlackbodyColours::bytes, stars);
  if (shows_spikes(plan.maximum(), ViewMode::sky)) {
    const bool changes = find_animation(plan.maximum(), "effects.diffraction.obstruction") != nullptr ||
                         find_animation(plan.maximum(), "effects.diffraction.scale") != nullptr;
    plan.buffer("diffraction pattern", turns || changes ? WorkMoment::picture : WorkMoment::start, 0,
                plan.why("effects.diffraction"));
  }
}

//! Adds the gathering of stars for each region of a picture (PictureRegion).
void plan_gathering(PlanWriter& plan) {
  long gathers = 0;
  long pixels = 0;
  for (const PictureRegion& region : picture_regions(plan.projection())) {
    ++gathers;
    pixels += static_cast<long>(region.cell.width_px) * region.cell.height_px;
  }
  plan.pass("gather_stars", WorkMoment::picture, plan.eyes() * gathers, plan.eyes() * pixels, plan.why("stars.method"));
}

void plan_star_drawing(PlanWriter& plan, const StarNeeds& needs) {
  const std::string stars = plan.why("sky.stars");
  if (needs.gather) {
    plan_gathering(plan);
    plan.pass("trace_rays, double", WorkMoment::picture, 0, 0, plan.why("stars.method"));
  } else {
    plan_grid(plan, stars, false);
    plan.buffer("shadow edge", WorkMoment::position, 0, stars);
    // The search of patches is skipped if the previous picture had the same camera, or one that
    // was only turned slightly. Eyes that see the same stars share one search.
    const bool may_share =
        plan.eyes() > 1 && (share_camera(plan.maximum().stereo) || plan.eyes_are_together_at_times());
    plan.buffer("star images", WorkMoment::picture, 0, stars);
    plan.pass("search_patches", WorkMoment::picture, may_share ? 0 : plan.eyes(), 0, stars, true);
    plan.pass("find_star_images", WorkMoment::picture, 0, 0, stars, true);
    plan.pass("find_star_images, double", WorkMoment::picture, 0, 0, stars, true);
  }
  if (needs.trails) {
    plan.pass("follow_trails", WorkMoment::picture, plan.eyes(), 0, plan.why("effects.trails"),
              !star_needs(plan.minimum(), ViewMode::sky).trails);
    if (needs.gather) {
      plan.pass("find_star_images", WorkMoment::picture, 0, 0, plan.why("effects.trails"), true);
      plan.pass("find_star_images, double", WorkMoment::picture, 0, 0, plan.why("effects.trails"), true);
    }
  }
  if (!plan.on_cpu()) {
    // Stars are searched for and drawn in the memory in which the picture is rendered.
    if (!needs.gather) {
      plan.buffer("star search", WorkMoment::start, 0, stars);
      plan.pass("place_star_images", WorkMoment::picture, 0, 0, stars, true);
    }
    plan.buffer("star points", WorkMoment::picture, 0, stars);
    plan.buffer("star tiles", WorkMoment::picture, 0, stars);
    if (needs.spikes) {
      plan.buffer("diffraction pattern, placed", WorkMoment::picture, 0, plan.why("effects.diffraction"));
    }
  }
  plan.pass("splat_stars", WorkMoment::picture, plan.eyes() * plan.blocks(), 0, stars, true);
  if (needs.spikes) {
    plan.pass("draw_spikes", WorkMoment::picture, plan.eyes() * plan.blocks(), 0, plan.why("effects.diffraction"),
              true);
  }
}

}  // namespace

void plan_stars(PlanWriter& plan) {
  if (!plan.maximum().sky.stars.empty()) {
    plan_star_loading(plan);
  }
  const StarNeeds needs = star_needs(plan.maximum(), plan.request().mode);
  if (needs.stars) {
    plan_star_drawing(plan, needs);
  }
}

}  // namespace ergodome
