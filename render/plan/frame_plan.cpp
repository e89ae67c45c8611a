#include "render/plan/frame_plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "content/animated_show.h"
#include "render/disk/disk_pass.h"
#include "render/frame/show_renderer.h"
#include "render/lens/edge_table.h"
#include "render/lens/lens_choice.h"
#include "render/plan/frame_needs.h"
#include "render/shells/shell_pass.h"
#include "render/sky/column_sums.h"
#include "render/stars/blackbody_colours.h"
#include "render/stars/picture_sheets.h"

namespace ergodome {

namespace {

class Planner {
 public:
  Planner(const Show& show, const FrameRequest& request)
      : show_(show_at_most(show)),
        least_(show_at_least(show)),
        request_(request),
        needs_(frame_needs(show_, request.mode)),
        always_(frame_needs(least_, request.mode)) {
    const int size_px = request.size_px > 0 ? request.size_px : show.view.size_px;
    const Projection projection = make_projection(show_.view, size_px, 0.0);
    plan_.width_px = projection.width_px;
    plan_.height_px = projection.height_px;
    plan_.eyes = drawn_pictures(show_.stereo);
    shown_ = eye_count(show.stereo);
    pixels_ = static_cast<long>(projection.width_px) * projection.height_px;
    block_rows_ = rows_of_a_block(projection.width_px, projection.height_px);
    blocks_ = (projection.height_px + block_rows_ - 1) / block_rows_;
    channels_ = lens_channels(request.mode, needs_.shading);
    for (const PictureSheet& sheet : picture_sheets(projection)) {
      ++gathers_;
      gathered_pixels_ += static_cast<long>(sheet.cell.width_px) * sheet.cell.height_px;
    }
  }

  FramePlan plan() {
    plan_channels();
    plan_lens();
    plan_shading();
    if (!show_.sky.stars.empty()) {
      plan_star_loading();
    }
    if (needs_.stars) {
      plan_stars();
    }
    plan_near_field();
    plan_objects();
    plan_light();
    return plan_;
  }

 private:
  //! A key with where it stands.
  [[nodiscard]] std::string why(const std::string& key) const {
    const auto line = show_.lines.find(key);
    const std::string reason = line != show_.lines.end()
                                   ? fmt::format("{} ({}.toml line {})", key, show_.name, line->second)
                                   : fmt::format("{} (by default)", key);
    return reason + why_animated(key);
  }

  //! Where the key, or a number of that part of the show, is animated.
  [[nodiscard]] std::string why_animated(const std::string& key) const {
    std::string lines;
    for (const Animation& animation : show_.timeline.animations) {
      const auto line = show_.lines.find("animate." + animation.path);
      if ((animation.path == key || animation.path.starts_with(key + ".") || animation.path.starts_with(key + "[")) &&
          line != show_.lines.end()) {
        lines += fmt::format("{}{}", lines.empty() ? ", animated from line " : ", ", line->second);
      }
    }
    return lines;
  }

  //! Whether the sky turns, and is read again for each picture.
  [[nodiscard]] bool sky_turns() const {
    return find_animation(show_, "sky.spin_axis.ra_deg") != nullptr ||
           find_animation(show_, "sky.spin_axis.dec_deg") != nullptr;
  }

  [[nodiscard]] std::string why_view() const {
    return request_.mode == ViewMode::sky ? why("sky.map") : std::string("the view that was asked for");
  }

  void pass(const std::string& name, WorkMoment moment, long runs, long elements, const std::string& reason,
            bool if_needed = false) {
    plan_.passes.push_back({name, moment, runs, elements, if_needed, reason});
  }

  void buffer(const std::string& name, WorkMoment moment, long bytes, const std::string& reason) {
    plan_.buffers.push_back({"buffer: " + name, moment, bytes, reason});
  }

  //! A pass over all pixels of all eyes, block by block.
  void pixel_pass(const std::string& name, const std::string& reason, bool if_needed = false) {
    // Where the baseline comes and goes, one picture serves both eyes at times.
    const bool known = drawn_pictures(least_.stereo) == plan_.eyes;
    pass(name, WorkMoment::picture, known ? plan_.eyes * blocks_ : 0, known ? plan_.eyes * pixels_ : 0, reason,
         if_needed);
  }

  void plan_channels() {
    const auto channel = [&](bool wanted, const char* name, int floats, const std::string& reason) {
      if (wanted) {
        plan_.channels.push_back({name, floats, reason});
      }
    };
    const bool sky = request_.mode == ViewMode::sky;
    channel(true, "coverage", 1, "every picture has a shadow");
    channel(true, "error_estimate", 1, "every picture says which rays failed");
    channel(channels_.sky, "sky", 3, why_view());
    channel(channels_.footprint, "footprint", 6,
            sky ? why(needs_.shading.brightening ? "sky.brightening" : "sky.filter") : why_view());
    channel(channels_.frequency_ratio, "frequency_ratio", 1, sky ? why("effects.redshift") : why_view());
    channel(channels_.steps, "steps", 1, why_view());
    channel(channels_.half_orbits, "half_orbits", 1, why_view());
    const long block = static_cast<long>(block_rows_) * plan_.width_px;
    constexpr long float_bytes = sizeof(float);
    buffer("lens channels", WorkMoment::start, channels_.floats() * block * float_bytes, "the channels above");
    buffer("picture", WorkMoment::start, 4 * block * float_bytes, why("view.size_px"));
    buffer("finished picture", WorkMoment::picture, plan_.eyes * 4 * pixels_ * float_bytes, why("view.size_px"));
  }

  [[nodiscard]] std::string variant(const char* kernel) const {
    return channels_.footprint ? fmt::format("{}, footprints", kernel) : kernel;
  }

  //! A grid that is traced at each new place.
  void plan_grid(const std::string& reason, bool if_needed) {
    pass("trace_nodes", WorkMoment::place, 0, 0, reason, if_needed);
    pass("check_cells", WorkMoment::place, 0, 0, reason, if_needed);
    buffer("lens grid while it is traced", WorkMoment::place, 0, reason);
  }

  void plan_lens() {
    if (plan_.eyes > 1 && show_.stereo.model == StereoModel::omni) {
      return plan_omni();
    }
    const double pixels = static_cast<double>(pixels_);
    const bool asked = request_.lens == LensChoice::live || request_.lens == LensChoice::streamed;
    const std::string quality = why("quality.budget_px");
    if (shows_rays(request_.mode) || request_.lens == LensChoice::direct) {
      return plan_direct(why_view());
    }
    if (show_.grid_scheme == GridScheme::quadtree && request_.backend == Backend::cpu) {
      plan_.lens = "quadtree";
      pass("trace_rays, double", WorkMoment::place, 0, 0, why("grid.scheme"));
      return pixel_pass("read_quadtree_pixels", why("grid.scheme"));
    }
    const bool streamed = request_.streamed && request_.lens != LensChoice::live;
    if (!streamed && !asked && !is_worth_a_grid(request_.backend, pixels)) {
      return plan_direct(why("view.size_px"));
    }
    plan_.lens = streamed ? "streamed" : "live";
    plan_grid(quality, streamed);
    buffer("lens grid", WorkMoment::place, 0, quality);
    pixel_pass(variant("look_up_pixels"), quality, !asked);
    if (!asked) {
      // Where most of a grid would be left to rays.
      pixel_pass(variant("trace_pixels"), quality, true);
    }
    if (streamed) {
      buffer("lens grid of a place between stations", WorkMoment::picture, 0, quality);
    }
    buffer("shadow edge", WorkMoment::picture, 0, quality);
  }

  void plan_direct(const std::string& reason) {
    plan_.lens = "direct";
    pixel_pass(variant("trace_pixels"), reason);
    buffer("shadow edge", WorkMoment::picture, plan_.eyes * edge_points * static_cast<long>(sizeof(float)), reason);
  }

  //! As OmniChooser chooses.
  void plan_omni() {
    const std::string model = why("stereo.model");
    const bool asked = request_.lens == LensChoice::live || request_.lens == LensChoice::streamed;
    const bool traced = request_.backend != Backend::cpu || request_.lens == LensChoice::direct ||
                        shows_rays(request_.mode) ||
                        (!asked && !is_worth_a_grid(request_.backend, static_cast<double>(pixels_)));
    buffer("omni cameras", WorkMoment::picture, 0, model);
    plan_.lens = traced ? "direct" : "live";
    if (traced) {
      pixel_pass(variant("trace_omni_pixels"), model);
      return buffer("shadow edge", WorkMoment::picture, plan_.eyes * edge_points * static_cast<long>(sizeof(float)),
                    model);
    }
    plan_grid(model, !asked);
    buffer("lens grid", WorkMoment::place, 0, model);
    pixel_pass(variant("look_up_omni_pixels"), model, !asked);
    if (!asked) {
      // Where most of a grid would be left to rays, or these would have to be in double.
      pixel_pass(variant("trace_omni_pixels"), model, true);
      buffer("shadow edge", WorkMoment::picture, 0, model);
    }
  }

  void plan_shading() {
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

  //! The sky as its filter reads it.
  void plan_map(const SkyShading& shading) {
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
      // One to fit temperatures by, one for the kernels.
      sky_buffer("blackbody table", 2 * BlackbodyColours::bytes, why("sky.shift"));
    }
  }

  //! Whatever is shown: a window goes from view to view.
  void plan_star_loading() {
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

  void plan_stars() {
    const std::string stars = why("sky.stars");
    if (needs_.gather) {
      pass("gather_stars", WorkMoment::picture, plan_.eyes * gathers_, plan_.eyes * gathered_pixels_,
           why("stars.method"));
      pass("trace_rays, double", WorkMoment::picture, 0, 0, why("stars.method"));
    } else {
      plan_grid(stars, false);
      buffer("shadow edge", WorkMoment::place, 0, stars);
      pass("search_patches", WorkMoment::picture, plan_.eyes, 0, stars);
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
    pass("splat_stars", WorkMoment::picture, plan_.eyes * blocks_, 0, show_.effects.psf ? why("effects.psf") : stars,
         true);
    if (needs_.spikes) {
      pass("draw_spikes", WorkMoment::picture, plan_.eyes * blocks_, 0, why("effects.diffraction"), true);
    }
  }

  //! Tables are made whatever is shown.
  void plan_near_field() {
    if (show_.disk) {
      const bool recoloured = find_animation(show_, "disk.temperature_K") != nullptr;
      buffer("blackbody table", WorkMoment::start, BlackbodyColours::bytes,
             why(recoloured ? "disk.temperature_K" : "disk"));
      buffer("disk profile", WorkMoment::start, DiskPass::profile_bytes, why("disk"));
    }
    if (!show_.shells.empty()) {
      buffer("shells", WorkMoment::start, static_cast<long>(show_.shells.size()) * ShellPass::shell_bytes,
             why("shells"));
      if (std::ranges::any_of(show_.shells, [](const ShellSettings& shell) { return !shell.texture.empty(); })) {
        buffer("shell texture", WorkMoment::start, 0, why("shells"));
      }
    }
    // What one part is without at some times, the other has to itself.
    for (const bool shells : {true, false}) {
      if (shells ? needs_.shells : !always_.shells) {
        plan_near_rays(shells);
      }
    }
  }

  //! A ray for each pixel that may see something, whatever the sky's lens is: with shells or without.
  void plan_near_rays(bool shells) {
    const bool edges_move =
        find_animation(show_, "disk.outer") != nullptr || find_animation(show_, "hole.spin") != nullptr;
    const bool shells_go = needs_.shells != always_.shells;
    const std::string with = shells ? ", " + why("shells") : "";
    if (needs_.disk) {
      const bool pattern = needs_.disk_pattern;
      pixel_pass(near_field_name(pattern ? DiskDrawing::pattern : DiskDrawing::plain, shells),
                 why(pattern ? "disk.pattern" : "disk") + with,
                 edges_move || shells_go || !always_.disk || pattern != always_.disk_pattern);
    }
    if (needs_.disk_pattern && !always_.disk_pattern) {
      pixel_pass(near_field_name(DiskDrawing::plain, shells), why("disk.contrast") + with, true);
    }
    if (shells && (!always_.disk || edges_move)) {
      pixel_pass(near_field_name(DiskDrawing::none, true), why("shells"), needs_.disk || shells_go);
    }
  }

  //! A ray for each tile, some for each pixel of those that may see objects.
  void plan_traced_objects(const std::string& objects) {
    buffer("meshes", WorkMoment::start, 0, objects);
    if (!needs_.traced_objects) {
      return;
    }
    // How many pixels these take is not known beforehand.
    pass("mark_object_tiles", WorkMoment::picture, 0, 0, objects);
    pass("look_at_objects", WorkMoment::picture, 0, 0, objects, true);
    if (!always_.disk && !always_.shells) {
      pixel_pass("lay_objects", objects, needs_.disk || needs_.shells);
    }
    for (const char* const name : {"objects' tiles", "objects' pixels", "objects' picture"}) {
      buffer(name, WorkMoment::picture, 0, objects);
    }
  }

  //! Meshes are read, and OpenGL is opened, whatever is shown: a window goes from view to view.
  void plan_objects() {
    if (show_.objects.empty()) {
      return;
    }
    const std::string objects = why("objects");
    pass("load_meshes", WorkMoment::start, 1, static_cast<long>(show_.objects.size()), objects);
    if (has_objects(show_, ObjectMethod::trace)) {
      return plan_traced_objects(objects);
    }
    pass("open_gl", WorkMoment::start, 1, 1, objects);
    buffer("meshes", WorkMoment::start, request_.mesh_bytes, objects);
    if (!needs_.objects) {
      return;
    }
    const bool lit = std::ranges::any_of(show_.objects, &ObjectSettings::lit);
    const std::string tables = lit ? objects + ", " + why("light") : objects;
    pass("make_connection_table", WorkMoment::place, 0, 0, tables);
    buffer("connecting rays", WorkMoment::place, 0, tables);
    pass("draw_objects", WorkMoment::picture, plan_.eyes, plan_.eyes * pixels_, objects);
    buffer("objects' picture", WorkMoment::start, 0, objects);
  }

  void plan_light() {
    if (shown_ > 1 && show_.stereo.model == StereoModel::flat && show_.stereo.baseline > 0.0) {
      const bool at_times = !(least_.stereo.baseline > 0.0);
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

  //! Images are read whatever is shown; what is drawn depends on the time.
  void plan_overlays() {
    const Timeline& timeline = show_.timeline;
    if (!timeline.overlays.empty()) {
      buffer("overlay images", WorkMoment::start, request_.overlay_bytes, why("overlay"));
    }
    if (request_.mode != ViewMode::sky || (timeline.overlays.empty() && timeline.captions.empty())) {
      return;
    }
    if (!timeline.captions.empty()) {
      pass("set_captions", WorkMoment::start, 0, 0, why("caption"), true);
      buffer("captions", WorkMoment::start, 0, why("caption"));
    }
    pass("draw_overlay", WorkMoment::picture, 0, 0, why(timeline.captions.empty() ? "overlay" : "caption"), true);
  }

  const Show show_;   //!< with each animated number at its greatest
  const Show least_;  //!< and at its least
  const FrameRequest& request_;
  FrameNeeds needs_;   //!< at some time
  FrameNeeds always_;  //!< at all times
  LensChannels channels_;
  FramePlan plan_;
  long pixels_;
  long gathers_ = 0;          //!< a face of a cube each
  long gathered_pixels_ = 0;  //!< of all of them
  int block_rows_;
  int blocks_;
  int shown_ = 1;  //!< eyes that see what is drawn
};

}  // namespace

FramePlan plan_frame(const Show& show, const FrameRequest& request) { return Planner(show, request).plan(); }

}  // namespace ergodome
