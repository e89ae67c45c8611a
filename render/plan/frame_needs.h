#pragma once

#include <algorithm>

#include "content/show/show.h"
#include "kernels/image/shade_pixels.h"

// Decides which channels and effects a show's pictures need.

namespace ergodome {

//! Channels of LensPixels that a picture needs.
struct LensChannels {
  bool sky = false;        //!< three floats
  bool footprint = false;  //!< six floats
  bool frequency_ratio = false;
  bool steps = false;
  bool half_orbits = false;

  //! Returns the floats per pixel, including coverage and error estimate, which every picture has.
  [[nodiscard]] int floats() const {
    return 2 + (sky ? 3 : 0) + (footprint ? 6 : 0) + (frequency_ratio ? 1 : 0) + (steps ? 1 : 0) +
           (half_orbits ? 1 : 0);
  }
};

//! How the map's light is turned into pixel values.
struct SkyShading {
  SkyFilter filter = SkyFilter::ewa;
  SkyShift shift = SkyShift::none;
  bool brightening = false;
};

inline LensChannels lens_channels(ViewMode mode, const SkyShading& shading) {
  const bool sky = mode == ViewMode::sky;
  const bool wide = shading.filter != SkyFilter::point || shading.brightening;
  const bool shifted = shading.shift != SkyShift::none;
  return {sky, (sky && wide) || mode == ViewMode::magnification, (sky && shifted) || mode == ViewMode::frequency_ratio,
          mode == ViewMode::steps, mode == ViewMode::image_order};
}

//! Returns whether a mode is a heat map of the cost of following rays, which includes rays to
//! shells.
inline bool follows_rays(ViewMode mode) { return mode == ViewMode::steps || mode == ViewMode::error_estimate; }

//! The effects that a show's pictures need. Effects without anything to act on are off.
struct FrameNeeds {
  bool stars;
  bool gather;  //!< pixels gather their stars
  SkyShading shading;
  bool trails;  //!< only while the camera is on its path
  bool spikes;
  bool bloom;
  bool disk;
  bool disk_pattern;
  bool objects;         //!< drawn as polygons
  bool traced_objects;  //!< drawn by ray tracing
  bool shells;          //!< any visible shell; heat maps of rays show them as lines
  bool auto_exposure;
  bool clear_outside;  //!< set if light may be spread beyond the image

  //! Returns whether pictures need a pass over the whole picture, so that they cannot stay in the
  //! backend's memory.
  [[nodiscard]] bool finishes_pictures() const { return auto_exposure || bloom; }
};

inline FrameNeeds frame_needs(const Show& show, ViewMode mode) {
  const bool sky = mode == ViewMode::sky;
  const bool stars = sky && !show.sky.stars.empty();
  const EffectSettings& effects = show.effects;
  FrameNeeds needs{};
  needs.stars = stars;
  needs.gather = stars && show.sky.star_method == StarMethod::gather;
  needs.shading = {show.sky.filter, effects.redshift ? show.sky.shift : SkyShift::none, show.sky.brightening};
  needs.trails = stars && effects.trails && effects.trails->shutter_s > 0.0;
  needs.spikes = stars && effects.diffraction && effects.diffraction->strength > 0.0;
  needs.bloom = sky && effects.bloom && effects.bloom->strength > 0.0 && effects.bloom->radius_px > 0.0;
  needs.disk = sky && show.disk && show.disk->opacity > 0.0;
  needs.disk_pattern = needs.disk && show.disk->pattern != DiskPattern::none && show.disk->contrast > 0.0;
  needs.objects = sky && has_objects(show, ObjectMethod::polygon);
  needs.traced_objects = sky && has_objects(show, ObjectMethod::trace);
  const bool one_camera = eye_count(show.stereo) < 2 || show.stereo.model != StereoModel::omni;
  needs.shells = (sky || (follows_rays(mode) && one_camera)) && std::ranges::any_of(show.shells, is_visible);
  needs.auto_exposure = sky && show.tone.automatic.has_value();
  needs.clear_outside = needs.bloom || needs.spikes;
  return needs;
}

}  // namespace ergodome
