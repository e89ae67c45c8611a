#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/cli/commands.h"
#include "app/cli/option_checks.h"
#include "app/cli/output_file.h"
#include "app/cli/show_loading.h"
#include "app/cli/show_options.h"
#include "app/cli/summary_text.h"
#include "app/commands/inspect/inspect_fall.h"
#include "app/commands/inspect/inspect_kinds.h"
#include "app/commands/inspect/inspect_setup.h"
#include "app/commands/inspect/inspect_timeline.h"
#include "app/commands/inspect/inspect_trajectory.h"
#include "app/commands/inspect/show_notes.h"
#include "app/commands/inspect/show_summary.h"
#include "content/camera/camera_path.h"
#include "content/files/console.h"
#include "content/files/printable.h"
#include "content/show/animated_show.h"
#include "content/show/reading/motion_reader.h"
#include "content/show/reading/show_reader.h"
#include "content/sky/environment_image.h"
#include "content/sky/sky_map.h"
#include "kernels/core/angles.h"
#include "kernels/core/error.h"
#include "kernels/projection/pixel_measure.h"
#include "kernels/spacetime/shadow/critical_curve.h"
#include "render/frame/show_renderer.h"
#include "render/lens/grid/grid_builder.h"
#include "render/lens/grid/grid_picture.h"
#include "render/output/image_writer.h"

namespace ergodome {

namespace {

struct InspectOptions {
  std::string file;
  ShowSettings set;
  bool json = false;
  std::string picture;
  double time_s = 0.0;
  int size_px = 1024;
};

//! Returns the angular width [deg] of the shadow, seen from the show's camera at a time: the sum of
//! the edge's angles from the chart's center to both sides, γ = 0 and π.
double shadow_width_deg(const Show& show, double time_s) {
  const CameraPose pose = camera_pose(show, time_s);
  const ObserverMotion motion = !pose.velocity          ? show.camera.motion
                                : pose.velocity_in_rain ? ObserverMotion::rain_boost
                                                        : ObserverMotion::velocity;
  const CameraStation camera = make_camera_station(spacetime_at(show, time_s), pose.r, pose.theta, 0.0, motion,
                                                   pose.velocity.value_or(show.camera.velocity));
  const ShadowChart chart = make_shadow_chart(camera);
  return radian_deg * (edge_polar_angle(camera, chart, 0.0) + edge_polar_angle(camera, chart, pi));
}

nlohmann::json summary_of(const Show& show) {
  const ShowNotes notes = notes_of_files(show);
  nlohmann::json summary;
  const bool one_title = show.title.size() == 1 && show.title.contains("");
  summary["title"] = one_title ? nlohmann::json(show.title.at("")) : nlohmann::json(show.title);
  summary["duration_s"] = show.duration_s;
  summary["frames"] = frame_count(show);
  summary["spin"] = show.spin;
  summary["horizon_r"] = horizon_radius(spacetime_of(show));
  summary["observer"] = show.camera.keys.front().velocity ? "keys" : motion_name(show.camera.motion);
  summary["sky_map"] = show.sky.map;
  summary["projection"] = view_projection_names[static_cast<std::size_t>(show.view.projection)];
  summary["size_px"] = show.view.size_px;
  summary["stereo"] = stereo_layout_names[static_cast<std::size_t>(show.stereo.layout)];
  summary["stereo_model"] = stereo_model_names[static_cast<std::size_t>(show.stereo.model)];
  summary["baseline"] = show.stereo.baseline;
  summary["budget_px"] = show.quality.budget_px;
  summary["not_drawn_yet"] = nlohmann::json::array();
  for (const MissingFeature& missing : missing_features(show)) {
    summary["not_drawn_yet"].push_back(missing.problem);
  }
  summary["timeline"] = summary_of_timeline(show, notes.unusable);
  summary["idle"] = summary_of_unused_keys(show);
  summary["notes"] = notes.unseen;
  summary["maps"] = notes.repaired;
  summary["meshes"] = summary_of_meshes(show, notes.meshes);
  if (notes.stars) {
    summary["stars"] = summary_of_stars(show, notes);
  }
  if (const auto reduced = baseline_reductions(show)) {
    summary["narrowed_eyes"] = summary_of(*reduced);
    summary["narrowed_eyes"]["note"] = note_of(show, *reduced);
  }
  if (show.camera.orbit) {
    summary["fall"] = summary_of_fall(show);
  }
  for (const CameraKey& key : show.camera.keys) {
    const CameraPose pose = camera_pose(show, key.time_s);
    summary["keys"].push_back({{"t_s", key.time_s},
                               {"r", pose.r},
                               {"theta_deg", pose.theta * radian_deg},
                               {"phi_deg", pose.phi * radian_deg},
                               {"shadow_width_deg", shadow_width_deg(show, key.time_s)},
                               {"after_end", key.time_s > show.duration_s}});
  }
  return summary;
}

void print_sentences(const char* heading, const nlohmann::json& sentences) {
  if (!sentences.empty()) {
    print_out("\n{}\n", heading);
  }
  for (const auto& sentence : sentences) {
    print_out("  {}\n", sentence.get<std::string>());
  }
}

std::string text_of_value(const nlohmann::json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

//! Returns the English title of a show, otherwise its first title. Empty if the show has none.
std::string title_of(const nlohmann::json& titles) {
  return titles.empty() ? "" : titles.value("en", titles.front().get<std::string>());
}

void print_summary(const nlohmann::json& summary) {
  for (const auto& [name, value] : summary.items()) {
    // Parts of the summary that are printed separately.
    constexpr std::array apart = {"keys",  "fall",          "grid", "timeline", "idle",
                                  "notes", "narrowed_eyes", "maps", "meshes",   "stars"};
    if (std::ranges::find(apart, name) == apart.end()) {
      print_out("{:<16}{}\n", name, name == "title" && value.is_object() ? title_of(value) : text_of_value(value));
    }
  }
  if (summary.contains("stars")) {
    print_stars(summary["stars"]);
  }
  if (summary.contains("keys")) {
    print_out("\n{:>10} {:>12} {:>12} {:>12} {:>18}\n", "t [s]", "r [M]", "theta [deg]", "phi [deg]",
              "shadow width [deg]");
    for (const auto& key : summary["keys"]) {
      print_out("{:>10.3f} {:>12.6g} {:>12.4f} {:>12.4f} {:>18.4f}{}\n", key["t_s"].get<double>(),
                key["r"].get<double>(), key["theta_deg"].get<double>(), key["phi_deg"].get<double>(),
                key["shadow_width_deg"].get<double>(), key["after_end"].get<bool>() ? "  AFTER THE END" : "");
    }
  }
  if (summary.contains("fall")) {
    print_fall(summary["fall"]);
  }
  if (summary.contains("timeline")) {
    print_timeline(summary["timeline"]);
  }
  if (summary.contains("idle")) {
    print_unused_keys(summary["idle"]);
  }
  if (summary.contains("narrowed_eyes")) {
    print_out("\nreduced baseline\n  {}\n", summary["narrowed_eyes"]["note"].get<std::string>());
  }
  print_sentences("not visible", summary.value("notes", nlohmann::json::array()));
  print_sentences("maps", summary.value("maps", nlohmann::json::array()));
  print_meshes(summary.value("meshes", nlohmann::json::array()));
}

void print_grid(const nlohmann::json& grid) {
  print_out("\nlens grid at r = {:.6g} M, theta = {:.4f} deg: {}, {}{}, {} of these cells{} left to direct rays\n",
            grid["r"].get<double>(), grid["theta_deg"].get<double>(), counted(grid["nodes"].get<int>(), "node"),
            counted(grid["cells"].get<int>(), "cell"), grid["mirrored"].get<bool>() ? " (half the sky, mirrored)" : "",
            grid["left_to_rays"].get<int>(),
            grid.contains("left_to_rays_px") ? fmt::format(" ({} px)", grid["left_to_rays_px"].get<double>()) : "");
  print_out("{:>10} {:>8} {:>14}\n", "halvings", "cells", "left to rays");
  for (const auto& level : grid["levels"]) {
    print_out("{:>10} {:>8} {:>14}\n", level["halvings"].get<int>(), level["cells"].get<int>(),
              level["left_to_rays"].get<int>());
  }
}

nlohmann::json summary_of(const EnvironmentImage& image) {
  double sum[3] = {0.0, 0.0, 0.0};
  for (std::size_t i = 0; i < image.rgb.size(); ++i) {
    sum[i % 3] += image.rgb[i];
  }
  const double texels = static_cast<double>(image.width) * image.height;
  nlohmann::json summary = {{"name", image.name},
                            {"width", image.file_width},
                            {"height", image.file_width / 2},
                            {"read_width", image.width},
                            {"repaired_texels", image.repaired.all()},
                            {"mean_light", {sum[0] / texels, sum[1] / texels, sum[2] / texels}}};
  if (image.repaired.all() > 0) {
    summary["repaired"] = repair_text(image.repaired);
    summary["too_bright"] = image.repaired.too_bright;
    summary["below_zero"] = image.repaired.below_zero;
    summary["not_a_number"] = image.repaired.not_numbers;
  }
  return summary;
}

//! Builds the lens grid for a picture of the show at a time, at the show's budget and size. Stores
//! the budget, the angle of a pixel and the observer in `settings`, and counts in `statistics`.
LensStation grid_of(const Show& show, double time_s, GridSettings& settings, GridStatistics& statistics) {
  const EyeCamera eye = eye_camera(show_at(show, time_s), camera_pose(show, time_s), 0.0);
  settings.pixel = pixel_angle(make_projection(show.view, show.view.size_px, 0.0));
  settings.budget_px = show.quality.budget_px;
  settings.observer = aberration_to_rain(eye.spacetime, eye.r, eye.theta, eye.motion, eye.velocity);
  return build_lens_station(eye.spacetime, eye.r, eye.theta, settings, &statistics);
}

//! Draws the grid of a station to the PNG of --picture and adds its statistics to the summary.
void inspect_grid(const LensStation& station, double budget_px, const InspectOptions& options,
                  nlohmann::json& summary) {
  write_png(options.picture, draw_grid(station, options.size_px, budget_px), options.size_px, options.size_px);
  nlohmann::json& grid = summary["grid"];
  const std::vector<bool> flagged = flagged_leaves(station);
  grid = {{"r", station.r},
          {"theta_deg", station.theta * radian_deg},
          {"mirrored", station.mirrored},
          {"nodes", station.node_count()},
          {"cells", station.leaf_count()},
          {"left_to_rays", std::count(flagged.begin(), flagged.end(), true)}};
  for (const GridLevel& level : grid_levels(station)) {
    grid["levels"].push_back({{"halvings", level.halvings}, {"cells", level.leaves}, {"left_to_rays", level.flagged}});
  }
}

//! Returns whether a file is inspected as a sky map, given that it is neither a trajectory nor a
//! setup.
bool is_image(const std::filesystem::path& file) { return file.has_extension() && file.extension() != ".toml"; }

void run_for_trajectory(const InspectOptions& options) {
  nlohmann::json summary = summary_of_trajectory(options.file);
  if (!options.picture.empty()) {
    inspect_grid(station_of_trajectory(options.file, options.time_s), summary["budget_px"].get<double>(), options,
                 summary);
  }
  if (options.json) {
    print_out("{}\n", json_text(summary));
  } else {
    print_trajectory(summary);
    if (summary.contains("grid")) {
      print_grid(summary["grid"]);
    }
  }
  if (!summary["damaged"].empty()) {
    throw Error(
        options.file,
        fmt::format("{} of {} {} damaged", summary["damaged"].size(), counted(summary["stations"].size(), "station"),
                    summary["damaged"].size() == 1 ? "is" : "are"),
        "bake the show again; until then, playback interpolates across the damaged ones");
  }
}

//! Throws Error if a show names files that cannot be used. The summary lists them.
void require_usable_files(const std::string& show, const nlohmann::json& summary) {
  const FaultyFiles files = summary.contains("timeline") ? faulty_files(summary["timeline"]) : FaultyFiles{};
  if (files.faulty > 0) {
    throw Error(show, fmt::format("{} of {} cannot be used", files.faulty, counted(files.all, "referenced file")),
                "see the list above");
  }
}

void run(const InspectOptions& options) {
  require_other_png("--picture", options.picture, {options.file});
  const std::filesystem::path file = options.file;
  if (is_trajectory(file) || file.extension() == ".trajectory") {
    require_finished_trajectory(file);
    return run_for_trajectory(options);
  }
  require_inspectable(file);
  if (is_dome_setup(options.file)) {
    const nlohmann::json summary = inspect_setup(options.file, options.picture, options.size_px);
    if (options.json) {
      print_out("{}\n", json_text(summary));
    } else {
      print_setup(summary);
    }
    return;
  }
  nlohmann::json summary;
  if (is_image(file)) {
    summary = summary_of(read_environment_image(options.file));
  } else {
    const Show show = load_show(options.file, options.set);
    summary = summary_of(show);
    if (!options.picture.empty()) {
      require_time("inspect --time", show, options.time_s);
      GridSettings settings;
      GridStatistics statistics;
      const LensStation station = grid_of(show, options.time_s, settings, statistics);
      inspect_grid(station, settings.budget_px, options, summary);
      summary["grid"]["left_to_rays_px"] = std::round(statistics.flagged_px);
    }
  }
  if (options.json) {
    print_out("{}\n", json_text(summary));
  } else {
    print_summary(summary);
    if (summary.contains("grid")) {
      print_grid(summary["grid"]);
    }
  }
  require_usable_files(options.file, summary);
}

}  // namespace

void add_inspect_command(CLI::App& app) {
  auto options = std::make_shared<InspectOptions>();
  CLI::App* command = app.add_subcommand(
      "inspect", "Print the contents of a show, trajectory, dome setup or sky map, and check its files");
  command
      ->add_option("file", options->file,
                   "show (.toml or name of a built-in show), trajectory, dome setup (.toml) or equirectangular image")
      ->required();
  add_set_option(*command, options->set);
  CLI::Option* const picture =
      command
          ->add_option("--picture", options->picture,
                       "draw to this PNG: the lens grid of a show or trajectory, or the projectors of a dome")
          ->type_name("FILE");
  command->add_option("--time", options->time_s, "with --picture: time in the show [s]")
      ->check(show_time())
      ->needs(picture)
      ->capture_default_str();
  command->add_option("--size", options->size_px, "with --picture: width of the picture in pixels")
      ->check(CLI::Range(16, 8192))
      ->needs(picture)
      ->capture_default_str();
  command->add_flag("--json", options->json, "print JSON");
  IgnoredOptions ignored(*command);
  ignored.add("for a sky map", [options] { return !is_trajectory(options->file) && is_image(options->file); },
              {"--picture", "--set"});
  ignored.add("for a dome setup", [options] { return is_dome_setup(options->file); }, {"--time", "--set"});
  ignored.add("for a trajectory", [options] { return is_trajectory(options->file); }, {"--set"});
  command->callback([options, ignored] {
    ignored.refuse();
    run(*options);
  });
}

}  // namespace ergodome
