#include "render/plan/planner.h"

#include <fmt/format.h>

#include <algorithm>

#include "content/show/animated_show.h"
#include "render/frame/show_renderer.h"
#include "render/passes/stars/drawing/picture_sheets.h"

namespace ergodome {

Planner::Planner(const Show& show, const FrameRequest& request)
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
  block_rows_ = rows_of_a_block(request.backend, projection.width_px, projection.height_px);
  blocks_ = (projection.height_px + block_rows_ - 1) / block_rows_;
  strips_ = count_strips();
  channels_ = lens_channels(request.mode, needs_.shading);
  for (const PictureSheet& sheet : picture_sheets(projection)) {
    ++gathers_;
    gathered_pixels_ += static_cast<long>(sheet.cell.width_px) * sheet.cell.height_px;
  }
}

namespace {
bool has_near_field(const FrameNeeds& needs) { return needs.disk || needs.shells || needs.traced_objects; }
}  // namespace

bool Planner::makes_eyes_in_turn() const {
  return request_.backend == Backend::cpu && shown_ > 1 && show_.stereo.model == StereoModel::physical &&
         !has_near_field(always_);
}

int Planner::count_strips() const {
  if (!makes_eyes_in_turn()) {
    return blocks_;
  }
  if (has_near_field(needs_)) {
    return 0;
  }
  const int strip = rows_of_a_strip(plan_.width_px);
  int strips = 0;
  for (int row = 0; row < plan_.height_px; row += block_rows_) {
    strips += (std::min(block_rows_, plan_.height_px - row) + strip - 1) / strip;
  }
  return strips;
}

FramePlan Planner::plan() {
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

std::string Planner::why(const std::string& key) const {
  const auto line = show_.lines.find(key);
  const std::string reason = line == show_.lines.end() ? fmt::format("{} (by default)", key)
                             : line->second == key_set_outside
                                 ? fmt::format("{} ({})", key, show_setting_option)
                                 : fmt::format("{} ({}.toml line {})", key, show_.name, line->second);
  return reason + why_animated(key);
}

std::string Planner::why_animated(const std::string& key) const {
  std::string lines;
  for (const Animation& animation : show_.timeline.animations) {
    const auto line = show_.lines.find("animate." + animation.path);
    if ((animation.path == key || animation.path.starts_with(key + ".") || animation.path.starts_with(key + "[")) &&
        line != show_.lines.end()) {
      const std::string from =
          line->second == key_set_outside ? show_setting_option : fmt::format("line {}", line->second);
      lines += (lines.empty() ? ", animated from " : ", ") + from;
    }
  }
  return lines;
}

bool Planner::sky_turns() const {
  return find_animation(show_, "sky.spin_axis.ra_deg") != nullptr ||
         find_animation(show_, "sky.spin_axis.dec_deg") != nullptr;
}

std::string Planner::why_view() const {
  return request_.mode == ViewMode::sky ? why("sky.map") : std::string("the requested view");
}

void Planner::pass(const std::string& name, WorkMoment moment, long runs, long elements, const std::string& reason,
                   bool if_needed) {
  plan_.passes.push_back({name, moment, runs, elements, if_needed, reason});
}

void Planner::buffer(const std::string& name, WorkMoment moment, long bytes, const std::string& reason) {
  plan_.buffers.push_back({"buffer: " + name, moment, bytes, reason});
}

void Planner::pixel_pass(const std::string& name, const std::string& reason, bool if_needed) {
  // If the baseline is 0 at times, one picture serves both eyes then.
  const bool known = drawn_pictures(least_.stereo) == plan_.eyes;
  pass(name, WorkMoment::picture, known ? plan_.eyes * strips_ : 0, known ? plan_.eyes * pixels_ : 0, reason,
       if_needed);
}

void Planner::plan_channels() {
  const auto channel = [&](bool wanted, const char* name, int floats, const std::string& reason) {
    if (wanted) {
      plan_.channels.push_back({name, floats, reason});
    }
  };
  const bool sky = request_.mode == ViewMode::sky;
  channel(true, "coverage", 1, "every picture shows the shadow");
  channel(true, "error_estimate", 1, "the failed rays of every picture are counted");
  channel(channels_.sky, "sky", 3, why_view());
  channel(channels_.footprint, "footprint", 6,
          sky ? why(needs_.shading.brightening ? "sky.brightening" : "sky.filter") : why_view());
  channel(channels_.frequency_ratio, "frequency_ratio", 1, sky ? why("effects.redshift") : why_view());
  channel(channels_.steps, "steps", 1, why_view());
  channel(channels_.half_orbits, "half_orbits", 1, why_view());
  const long block = static_cast<long>(block_rows_) * plan_.width_px;
  constexpr long float_bytes = sizeof(float);
  buffer("lens channels", WorkMoment::start, channels_.floats() * block * float_bytes, "the channels above");
  if (request_.backend != Backend::cpu) {
    // On the CPU the light is written directly into the finished picture.
    buffer("picture", WorkMoment::start, 4 * block * float_bytes, why("view.size_px"));
  }
  buffer("finished picture", WorkMoment::picture, plan_.eyes * 4 * pixels_ * float_bytes, why("view.size_px"));
}

FramePlan plan_frame(const Show& show, const FrameRequest& request) { return Planner(show, request).plan(); }

}  // namespace ergodome
