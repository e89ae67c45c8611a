#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "content/objects/object_checks.h"
#include "render/accuracy/axes/axes.h"
#include "render/accuracy/axes/picture_race.h"

namespace ergodome {

namespace {

//! Maximum width of compared pictures. It is small because reference pictures take many samples per
//! pixel.
constexpr int max_map_px = 512;

//! Returns a copy of a show that has only its sky map, one eye, and the animations of the hole and
//! of the sky's exposure.
Show map_alone(Show show) {
  show.sky.stars.clear();
  show.disk.reset();
  show.shells.clear();
  show.objects.clear();
  show.effects.bloom.reset();
  show.effects.diffraction.reset();
  show.effects.trails.reset();
  show.stereo = {};
  std::erase_if(show.timeline.animations, [](const Animation& animation) {
    return !animation.path.starts_with("hole.") && !animation.path.starts_with("sky.exposure");
  });
  return show;
}

Show with_filter(Show show, SkyFilter filter) {
  show.sky.filter = filter;
  return show;
}

}  // namespace

AccuracyAxis measure_map(const Show& show, const AccuracySettings& asked, const AccuracyProgress& progress) {
  const AccuracySettings settings = no_wider(asked, show, max_map_px);
  const int blocks = settings.quick ? 3 : 4;
  const Show alone = map_alone(show);
  const std::vector<AccuracyMoment> moments = accuracy_moments(alone, settings);
  report_progress(progress, "loading the sky of the reference");
  ShowRenderer exact(with_filter(alone, SkyFilter::polygon), Backend::cpu, LensChoice::direct);
  const ReferencePicture reference = [&](const AccuracyMoment& moment, const CameraPose& pose) {
    exact.apply(moment.time_s);
    Projection fine = moment.projection;
    fine.width_px *= blocks;
    fine.height_px *= blocks;
    return averaged(exact.render_eye(pose, 0.0, fine, ViewMode::sky, {moment.time_s}), blocks);
  };
  const std::vector<PictureChoice> choices = {
      {"point", "one sample of the finest texels", "", with_filter(alone, SkyFilter::point), LensChoice::live},
      {"ewa", "ellipse", "", with_filter(alone, SkyFilter::ewa), LensChoice::live},
      {"polygon", "outline of the pixel", "VE", with_filter(alone, SkyFilter::polygon), LensChoice::live}};
  AccuracyAxis axis;
  axis.name = "map";
  axis.title = "Filtering of the sky map";
  axis.unit = ErrorUnit::light;
  axis.reference = fmt::format(
      "the light of the map in {0} x {0} parts of each pixel, each integrated exactly, with direct rays, in percent of "
      "the mean luminance of the picture, in pictures {1} pixels wide",
      blocks, moments.front().projection.width_px);
  axis.choices = measure_pictures(choices, reference, moments, settings, progress);
  return axis;
}

AccuracyAxis measure_frames(const Show& show, const AccuracySettings& settings, const AccuracyProgress& progress) {
  const AccuracySettings asked = paced(settings, show);
  Show mono = show;
  mono.stereo = {};
  std::erase_if(mono.timeline.animations,
                [](const Animation& animation) { return animation.path.starts_with("stereo."); });
  const auto at_budget = [&](double budget_px) {
    Show changed = mono;
    changed.quality.budget_px = budget_px;
    return changed;
  };
  Show published = mono;
  published.grid_scheme = GridScheme::quadtree;
  const std::vector<AccuracyMoment> moments = accuracy_moments(mono, asked);
  report_progress(progress, "loading the sky of the reference");
  ShowRenderer exact(at_budget(0.005), Backend::cpu, LensChoice::direct);
  const ReferencePicture reference = [&](const AccuracyMoment& moment, const CameraPose& pose) {
    exact.apply(moment.time_s);
    return exact.render_eye(pose, 0.0, moment.projection, ViewMode::sky, {moment.time_s});
  };
  std::vector<PictureChoice> choices = {{"direct rays", "budget 0.25 px", "", at_budget(0.25), LensChoice::direct},
                                        {"quadtree", "level 10, spline", "VE", published, LensChoice::live}};
  for (const double budget_px :
       asked.quick || draws_slowly(show) ? std::vector<double>{0.25} : std::vector<double>{1.0, 0.25, 0.05}) {
    choices.push_back(
        {"conforming grid", fmt::format("budget {:g} px", budget_px), "", at_budget(budget_px), LensChoice::live});
  }
  AccuracyAxis axis;
  axis.name = "frame";
  axis.title = "Complete frames of the show, for one eye";
  axis.unit = ErrorUnit::light;
  axis.reference = fmt::format(
      "the same frame with direct rays exact to a thousandth of a pixel, in percent of the mean luminance of the "
      "picture, in pictures {} pixels wide",
      moments.front().projection.width_px);
  axis.choices = measure_pictures(choices, reference, moments, asked, progress);
  return axis;
}

namespace {

//! Returns a copy of a show that has only disk, shells and objects, in front of a black sky, seen
//! by one eye, without bloom, diffraction and trails.
Show near_things_alone(Show show) {
  show.sky.map = "grid";
  show.sky.map_layout = {};
  show.sky.filter = SkyFilter::point;
  show.sky.exposure = 0.0;
  show.sky.stars.clear();
  show.effects.bloom.reset();
  show.effects.diffraction.reset();
  show.effects.trails.reset();
  show.stereo = {};
  std::erase_if(show.timeline.animations, [](const Animation& animation) {
    return animation.path.starts_with("sky.") || animation.path.starts_with("stereo.") ||
           animation.path.starts_with("effects.");
  });
  return show;
}

Show by_method(Show show, ObjectMethod method) {
  for (ObjectSettings& object : show.objects) {
    object.method = method;
  }
  return show;
}

Show by_rays(const Show& show, double budget_px) {
  Show changed = by_method(show, ObjectMethod::trace);
  changed.quality.budget_px = budget_px;
  return changed;
}

Show by_polygons(const Show& show, int max_divisions) {
  Show changed = by_method(show, ObjectMethod::polygon);
  for (ObjectSettings& object : changed.objects) {
    object.tessellation.maximum = max_divisions;
  }
  return changed;
}

//! Returns whether the published polygons can draw a show's objects; false if it has none, or if
//! one is retarded (seen where it was when the light left it).
bool polygons_can_draw(const Show& show) {
  const Show drawn = by_method(show, ObjectMethod::polygon);
  const bool waits = std::ranges::any_of(show.objects, &ObjectSettings::retarded);
  return !show.objects.empty() && !waits && !polygon_limit(drawn).has_value();
}

std::vector<PictureChoice> near_choices(const Show& show, bool quick) {
  std::vector<PictureChoice> choices;
  for (const double budget_px : quick ? std::vector<double>{1.0, 0.25} : std::vector<double>{1.0, 0.25, 0.05}) {
    choices.push_back(
        {"rays", fmt::format("budget {:g} px", budget_px), "", by_rays(show, budget_px), LensChoice::direct});
  }
  if (polygons_can_draw(show)) {
    for (const int maximum : {1, 4, 64}) {
      choices.push_back({"polygons", fmt::format("subdivision up to {}", maximum), "MSW", by_polygons(show, maximum),
                         LensChoice::direct});
    }
  }
  return choices;
}

}  // namespace

AccuracyAxis measure_near(const Show& show, const AccuracySettings& asked, const AccuracyProgress& progress) {
  AccuracySettings settings = paced(asked, show);
  settings.rounds = std::min(settings.rounds, 3);
  const Show alone = near_things_alone(show);
  const std::vector<AccuracyMoment> moments = accuracy_moments(alone, settings);
  report_progress(progress, "reference of disk, shells and objects");
  ShowRenderer exact(by_rays(alone, 0.005), Backend::cpu, LensChoice::direct);
  const ReferencePicture reference = [&](const AccuracyMoment& moment, const CameraPose& pose) {
    exact.apply(moment.time_s);
    return exact.render_eye(pose, 0.0, moment.projection, ViewMode::sky, {moment.time_s});
  };
  AccuracyAxis axis;
  axis.name = "near";
  axis.title = "Disk, shells and objects against a black sky";
  axis.unit = ErrorUnit::light;
  axis.reference = fmt::format(
      "rays exact to a thousandth of a pixel, in percent of the mean luminance of the lit pixels, in pictures {} "
      "pixels wide",
      moments.front().projection.width_px);
  axis.choices = measure_pictures(near_choices(alone, settings.quick), reference, moments, settings, progress);
  return axis;
}

}  // namespace ergodome
