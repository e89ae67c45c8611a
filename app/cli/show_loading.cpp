#include "app/cli/show_loading.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <string_view>

#include "app/cli/usage_error.h"
#include "content/files/console.h"
#include "content/objects/object_checks.h"
#include "content/show/animated_show.h"
#include "content/show/show_reader.h"
#include "content/show/stereo_eyes.h"
#include "content/sky/sky_map.h"
#include "kernels/core/error.h"
#include "render/lens/lens_source.h"

namespace ergodome {

namespace {

//! Parses a number. Returns whether the whole text is a number.
bool is_number(std::string_view text, double& number) {
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
  return problem == std::errc() && end == text.data() + text.size();
}

std::vector<std::string> built_in_shows(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  std::error_code problem;
  for (const auto& entry : std::filesystem::directory_iterator(folder, problem)) {
    if (entry.path().extension() == ".toml") {
      names.push_back(entry.path().stem().string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

//! Reads a show file. Turns errors caused by --set into usage errors.
Show read_set_show(const std::filesystem::path& path, const ShowSettings& settings) {
  try {
    return read_show_with_settings(path, settings);
  } catch (const Error& error) {
    if (error.place().starts_with(show_setting_option)) {
      throw UsageError(error.place(), error.problem(), error.remedy());
    }
    throw;
  }
}

}  // namespace

Show load_show(const std::string& name_or_path, const ShowSettings& settings) {
  std::error_code problem;
  // A folder with the name of a built-in show does not hide it.
  if (std::filesystem::exists(name_or_path, problem) && !std::filesystem::is_directory(name_or_path, problem)) {
    return read_set_show(name_or_path, settings);
  }
  const std::filesystem::path folder = built_in_content_folder() / "shows";
  const std::filesystem::path built_in = folder / (name_or_path + ".toml");
  if (name_or_path.find('/') == std::string::npos && std::filesystem::exists(built_in, problem)) {
    return read_set_show(built_in, settings);
  }
  throw Error(name_or_path.empty() ? "\"\"" : name_or_path, "is neither a file nor a built-in show",
              fmt::format("built-in shows: {}", fmt::join(built_in_shows(folder), ", ")));
}

CLI::Option* add_set_option(CLI::App& command, ShowSettings& settings) {
  return command
      .add_option(show_setting_option, settings,
                  "override a key of the show, such as hole.spin=0.5 or camera.key.0.r=30; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

std::vector<std::string> object_method_names() { return {"polygon", "trace"}; }

std::vector<std::string> stereo_names() { return {stereo_layout_names.begin(), stereo_layout_names.end()}; }

std::vector<std::string> projection_names() { return {"dome", "equirect", "cube", "cylinder", "pinhole"}; }

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

void override_view(Show& show, const std::string& projection, const std::string& stereo) {
  if (!projection.empty()) {
    const std::vector<std::string> names = projection_names();
    const auto chosen = static_cast<ViewProjection>(std::find(names.begin(), names.end(), projection) - names.begin());
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

void require_two_eyes(const Show& show, const std::string& option, bool given) {
  if (given && eye_count(show.stereo) == 1) {
    throw UsageError(option, show.name + " is not stereo", "leave it out, or add for example --stereo side_by_side");
  }
}

void tell_equal_eyes(const Show& show) {
  if (eye_count(show.stereo) > 1 && !(show_at_most(show).stereo.baseline > 0.0)) {
    print_note("both eyes see the same picture, because stereo.baseline of the show is 0; set it with --baseline");
  }
}

void require_time(const std::string& option, const Show& show, double time_s) {
  if (!(time_s >= 0.0 && time_s <= show.duration_s)) {
    throw UsageError(option, fmt::format("{:.9g} s is outside {}", time_s, show.name),
                     fmt::format("choose from 0 to {:.9g} s", show.duration_s));
  }
}

void require_features(const Show& show) {
  const std::vector<MissingFeature> missing = missing_features(show);
  if (!missing.empty()) {
    throw Error(show.name + ".toml", missing.front().problem, missing.front().remedy);
  }
}

std::vector<std::string> view_mode_names() { return {"sky", "steps", "error", "order", "g", "magnification"}; }

ViewMode view_mode(const std::string& name) {
  const std::vector<std::string> names = view_mode_names();
  return static_cast<ViewMode>(std::find(names.begin(), names.end(), name) - names.begin());
}

std::optional<ViewRange> view_range(const std::string& text, ViewMode mode, bool logarithmic_steps) {
  if (text.empty()) {
    return std::nullopt;
  }
  const std::string option = "--view-range " + text;
  if (mode == ViewMode::sky) {
    throw UsageError(option, "applies only to heat maps, not to the sky", "add --view, for instance --view g");
  }
  const std::size_t colon = text.find(':');
  ViewRange range{};
  const bool parsed = colon != std::string::npos && is_number(std::string_view(text).substr(0, colon), range.low) &&
                      is_number(std::string_view(text).substr(colon + 1), range.high);
  if (!parsed || !std::isfinite(range.low) || !std::isfinite(range.high) || !(range.low < range.high)) {
    throw UsageError(option, "is not a range", "write MIN:MAX with MIN below MAX, for instance 0.5:2");
  }
  if (heat_range(mode, logarithmic_steps).logarithmic && !(range.low > 0.0)) {
    throw UsageError(option, "starts at 0 or below, but this view has a logarithmic scale", "choose a minimum above 0");
  }
  return range;
}

std::vector<std::string> follow_method_names() { return {"taylor", "rk34", "cash_karp", "baseline_rk34"}; }

std::optional<TraceMethod> follow_method(const std::string& name, const std::string& view, const Show& show) {
  if (name.empty()) {
    return std::nullopt;
  }
  if (!follows_rays(view_mode(view))) {
    throw UsageError("--method " + name, "applies only to heat maps of steps and errors",
                     "add --view steps or --view error");
  }
  if (has_camera_per_direction(show.stereo)) {
    throw UsageError("--method " + name, "traces rays of one camera, but stereo model omni has a camera for each pixel",
                     "add --stereo mono");
  }
  constexpr TraceMethod methods[] = {TraceMethod::taylor, TraceMethod::rk34, TraceMethod::cash_karp,
                                     TraceMethod::baseline_rk34};
  const std::vector<std::string> names = follow_method_names();
  return methods[std::find(names.begin(), names.end(), name) - names.begin()];
}

}  // namespace ergodome
