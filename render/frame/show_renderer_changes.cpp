#include <optional>
#include <utility>

#include "content/show/animated_show.h"
#include "kernels/core/error.h"
#include "render/frame/show_renderer.h"

// Applies changed numbers or another show to a show's renderer.
namespace ergodome {

namespace {

bool same_turn(const SkySettings& a, const SkySettings& b) {
  return a.spin_axis_ra_deg == b.spin_axis_ra_deg && a.spin_axis_dec_deg == b.spin_axis_dec_deg;
}

//! Returns whether two shows use one map in the same way, so that it need not be read again.
bool same_map(const Show& a, const Show& b) {
  return a.folder == b.folder && a.sky.map == b.sky.map && a.sky.map_layout == b.sky.map_layout &&
         same_turn(a.sky, b.sky) && a.sky.filter == b.sky.filter && a.sky.shift == b.sky.shift &&
         a.effects.redshift == b.effects.redshift;
}

//! Returns whether two shows' spikes differ at most in animatable numbers.
bool same_spikes(const Show& a, const Show& b) {
  const auto& one = a.effects.diffraction;
  const auto& other = b.effects.diffraction;
  if (!one || !other) {
    return !one && !other;
  }
  const bool ever = shows_spikes(show_at_most(a), ViewMode::sky);
  return ever == shows_spikes(show_at_most(b), ViewMode::sky) && one->pattern == other->pattern &&
         one->blades == other->blades && one->vanes == other->vanes && one->size_px == other->size_px;
}

//! Returns whether two shows' stars differ at most in numbers that StarPass::set_numbers accepts.
bool same_stars(const Show& a, const Show& b) {
  return a.folder == b.folder && a.sky.stars == b.sky.stars && a.sky.star_method == b.sky.star_method &&
         same_turn(a.sky, b.sky) && a.effects.redshift == b.effects.redshift && same_spikes(a, b);
}

}  // namespace

void ShowRenderer::apply(double time_s) {
  time_s_ = time_s;
  const NumberChange change = animate(show_, time_s);
  if (change.sky) {
    sky_.turn(show_, backend());
    if (stars_) {
      stars_->turn_sky(show_);
    }
  }
  if (change.stars && stars_) {
    stars_->set_numbers(show_);
  }
  if (disk_) {
    disk_->set_numbers(show_);
  }
  if (shells_) {
    shells_->set_numbers(show_);
  }
  if (change.exposure && exposure_) {
    exposure_->set(*show_.tone.automatic);
  }
}

void ShowRenderer::set_quality(const FrameQuality& quality) {
  show_.quality.budget_px = quality.budget_px;
  lens_ = quality.lens;
  if (show_.sky.filter != SkyFilter::polygon && quality.filter != SkyFilter::polygon) {
    show_.sky.filter = quality.filter;
  }
}

FrameQuality ShowRenderer::quality() const { return {show_.quality.budget_px, lens_, show_.sky.filter}; }

void ShowRenderer::set_show(const Show& show, std::shared_ptr<StationStream> stream) {
  Show next = show_at(show, time_s_);
  const std::vector<MissingFeature> missing = missing_features(next);
  if (!missing.empty()) {
    throw Error(next.name, missing.front().problem, missing.front().remedy);
  }
  std::optional<ShowSky> sky;
  if (!same_map(show_, next)) {
    sky.emplace(next, backend());
  }
  std::unique_ptr<StarPass> stars;
  const bool other_stars = !same_stars(show_, next);
  if (other_stars && !next.sky.stars.empty()) {
    stars = std::make_unique<StarPass>(next, backend());
  }
  std::unique_ptr<DiskPass> disk = next.disk && !disk_ ? std::make_unique<DiskPass>(next, backend()) : nullptr;
  std::unique_ptr<TracedObjects> traced_objects = traced_objects_of(next, backend());
  std::unique_ptr<ObjectPass> objects = polygons_of(next);
  const bool same_shells = shells_ && same_shell_textures(show_, next);
  std::unique_ptr<ShellPass> shells =
      next.shells.empty() || same_shells ? nullptr : std::make_unique<ShellPass>(next, backend());
  overlays_.set_show(next);
  // Nothing below throws.
  if (sky) {
    sky_ = std::move(*sky);
  }
  if (other_stars) {
    stars_ = std::move(stars);
  } else if (stars_) {
    stars_->set_numbers(next);
  }
  if (!next.disk) {
    disk_.reset();
  } else if (disk_) {
    disk_->set_numbers(next);
  } else {
    disk_ = std::move(disk);
  }
  traced_objects_ = std::move(traced_objects);
  objects_ = std::move(objects);
  if (same_shells) {
    shells_->set_numbers(next);
  } else {
    shells_ = std::move(shells);
  }
  if (!next.tone.automatic) {
    exposure_.reset();
  } else if (exposure_) {
    exposure_->set(*next.tone.automatic);
  } else {
    exposure_.emplace(*next.tone.automatic);
  }
  show_ = std::move(next);
  stream_ = std::move(stream);
  renderer_.set_stream(stream_);
}

PlacedMeshes ShowRenderer::hiding_objects() const {
  return traced_objects_ ? traced_objects_->hiding(time_s_) : PlacedMeshes{};
}

std::vector<PlacedOutline> ShowRenderer::object_outlines() const {
  if (traced_objects_) {
    return traced_objects_->outlines(time_s_);
  }
  return objects_ ? objects_->outlines(time_s_) : std::vector<PlacedOutline>{};
}

}  // namespace ergodome
