#include "app/cli/show_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "app/cli/option_checks.h"
#include "app/cli/usage_error.h"
#include "content/objects/object_checks.h"
#include "content/show/animatable_number.h"
#include "content/show/reading/show_settings.h"

namespace ergodome {

namespace {

//! Returns a check for the limits of an animatable key of shows.
CLI::Validator within_limits_of(const char* path) {
  const auto limits = limits_of(path);
  return number_between(limits.minimum, limits.maximum);
}

void override_view(Show& show, const std::string& projection, const std::string& stereo) {
  if (!projection.empty()) {
    const auto name = std::ranges::find(view_projection_names, projection);
    const auto chosen = static_cast<ViewProjection>(name - view_projection_names.begin());
    if (chosen != show.view.projection) {
      show.view.projection = chosen;
      show.view.field_of_view_deg = usual_field_of_view_deg(chosen);
      std::erase_if(show.timeline.animations, [](const Animation& each) { return each.path == "view.fov_deg"; });
    }
  }
  if (!stereo.empty()) {
    const auto name = std::ranges::find(stereo_layout_names, stereo);
    show.stereo.layout = static_cast<StereoLayout>(name - stereo_layout_names.begin());
  }
}

void override_baseline(Show& show, const std::optional<double>& baseline) {
  if (baseline) {
    show.stereo.baseline = *baseline;
    show.lines.erase("stereo.baseline");
    show.lines.erase("animate.stereo.baseline");
    std::erase_if(show.timeline.animations, [](const Animation& each) { return each.path == "stereo.baseline"; });
  }
}

void override_tilt(Show& show, const std::optional<double>& tilt_deg, bool has_setup) {
  if (!tilt_deg) {
    return;
  }
  if (!has_setup && show.view.projection != ViewProjection::dome) {
    throw UsageError("--tilt", "applies only to domes, but the projection is another",
                     "leave it out, or add --projection dome");
  }
  show.view.tilt_deg = *tilt_deg;
  show.view.artistic_tilt = true;
  show.lines.erase("view.tilt_deg");
  show.lines.erase("animate.view.tilt_deg");
  std::erase_if(show.timeline.animations, [](const Animation& each) { return each.path == "view.tilt_deg"; });
}

void override_objects(Show& show, const std::string& method) {
  if (method.empty()) {
    return;
  }
  const bool trace = method == "trace";
  if (show.objects.empty()) {
    throw UsageError("--objects " + method, show.name + " has no objects", "leave it out");
  }
  for (ObjectSettings& object : show.objects) {
    object.method = trace ? ObjectMethod::trace : ObjectMethod::polygon;
    if (!trace && object.retarded) {
      throw UsageError("--objects polygon", "polygons cannot show retarded objects", "leave it out");
    }
  }
  const std::optional<PolygonLimit> limit = trace ? std::nullopt : polygon_limit(show);
  if (limit) {
    throw UsageError("--objects polygon", show.name + ": objects " + limit->problem, "leave it out");
  }
}

}  // namespace

CLI::Option* add_set_option(CLI::App& command, ShowSettings& settings) {
  return command
      .add_option(show_setting_option, settings,
                  "override a key of the show, such as hole.spin=0.5 or camera.key.0.r=30; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

void add_projection_options(CLI::App& command, ShowOverrides& overrides, const char* tilt_source) {
  command.option_defaults()->group("Picture");
  command.add_option("--projection", overrides.projection, "projection (default: the show's)")
      ->check(one_of(view_projection_names));
  command
      .add_option("--tilt", overrides.tilt_deg,
                  std::string("tilt of the dome in degrees (default: ") + tilt_source + ")")
      ->check(within_limits_of("view.tilt_deg"));
}

void add_objects_option(CLI::App& command, ShowOverrides& overrides) {
  command
      .add_option("--objects", overrides.objects, "method of drawing objects: polygon or trace (default: the show's)")
      ->check(one_of(object_method_names));
}

void add_stereo_options(CLI::App& command, ShowOverrides& overrides) {
  command.option_defaults()->group("Stereo");
  command.add_option("--stereo", overrides.stereo, "stereo layout (default: the show's)")
      ->check(one_of(stereo_layout_names));
  command.add_option("--baseline", overrides.baseline, "distance between the eyes [M] (default: the show's)")
      ->check(within_limits_of("stereo.baseline"));
}

void apply_overrides(Show& show, const ShowOverrides& overrides, bool has_setup) {
  override_view(show, overrides.projection, overrides.stereo);
  override_baseline(show, overrides.baseline);
  override_tilt(show, overrides.tilt_deg, has_setup);
  override_objects(show, overrides.objects);
}

}  // namespace ergodome
