#include "render/plan/plan_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "content/show/animated_show.h"
#include "content/show/stereo_eyes.h"
#include "render/eyes/view_projection.h"
#include "render/picture/picture_rows.h"

namespace ergodome {

PlanWriter::PlanWriter(const Show& show, const FrameRequest& request, std::span<const PassKind> kinds)
    : maximum_(show_at_most(show)),
      minimum_(show_at_least(show)),
      request_(request),
      kinds_(kinds),
      projection_(make_projection(maximum_.view, request.size_px > 0 ? request.size_px : show.view.size_px, 0.0)),
      block_rows_(rows_of_a_block(request.backend, projection_.width_px, projection_.height_px)),
      shown_(eye_count(show.stereo)) {
  plan_.width_px = projection_.width_px;
  plan_.height_px = projection_.height_px;
  plan_.eyes = drawn_pictures(maximum_.stereo);
}

FramePlan PlanWriter::finish() { return std::move(plan_); }

int PlanWriter::blocks() const { return (height_px() + block_rows_ - 1) / block_rows_; }

bool PlanWriter::eyes_are_together_at_times() const { return !(minimum_.stereo.baseline > 0.0); }

bool PlanWriter::needs_one_picture(const Show& show) const {
  return std::ranges::any_of(
      kinds_, [&](const PassKind& kind) { return kind.serves_one_picture && kind.draws(show, request_.mode); });
}

bool PlanWriter::makes_eyes_in_turn() const {
  return on_cpu() && shown_ > 1 && eye_cameras(maximum_.stereo.model) == EyeCameras::own &&
         !needs_one_picture(minimum_);
}

int PlanWriter::strips() const {
  if (!makes_eyes_in_turn()) {
    return blocks();
  }
  if (needs_one_picture(maximum_)) {
    return 0;
  }
  int strips = 0;
  visit_rows({0, height_px()}, block_rows_, [&](const RowBlock& block) {
    visit_rows(block, rows_of_a_strip(width_px()), [&](const RowBlock&) { ++strips; });
  });
  return strips;
}

std::string PlanWriter::why(const std::string& key) const {
  const auto line = maximum_.lines.find(key);
  const std::string reason = line == maximum_.lines.end() ? fmt::format("{} (by default)", key)
                             : line->second == key_set_outside
                                 ? fmt::format("{} ({})", key, show_setting_option)
                                 : fmt::format("{} ({}.toml line {})", key, maximum_.name, line->second);
  return reason + why_animated(key);
}

std::string PlanWriter::why_animated(const std::string& key) const {
  std::string lines;
  for (const Animation& animation : maximum_.timeline.animations) {
    const auto line = maximum_.lines.find("animate." + animation.path);
    if ((animation.path == key || animation.path.starts_with(key + ".") || animation.path.starts_with(key + "[")) &&
        line != maximum_.lines.end()) {
      const std::string from =
          line->second == key_set_outside ? show_setting_option : fmt::format("line {}", line->second);
      lines += (lines.empty() ? ", animated from " : ", ") + from;
    }
  }
  return lines;
}

bool PlanWriter::sky_turns() const {
  return find_animation(maximum_, "sky.spin_axis.ra_deg") != nullptr ||
         find_animation(maximum_, "sky.spin_axis.dec_deg") != nullptr;
}

std::string PlanWriter::why_view() const {
  return request_.mode == ViewMode::sky ? why("sky.map") : std::string("the requested view");
}

void PlanWriter::channel(const char* name, int floats, const std::string& reason) {
  plan_.channels.push_back({name, floats, reason});
}

void PlanWriter::pass(const std::string& name, WorkMoment moment, long runs, long elements, const std::string& reason,
                      bool if_needed) {
  plan_.passes.push_back({name, moment, runs, elements, if_needed, reason});
}

void PlanWriter::buffer(const std::string& name, WorkMoment moment, long bytes, const std::string& reason) {
  plan_.buffers.push_back({"buffer: " + name, moment, bytes, reason});
}

void PlanWriter::pixel_pass(const std::string& name, const std::string& reason, bool if_needed) {
  // At times when the baseline is 0, one picture is rendered for both eyes, so the number of runs
  // is not known.
  const bool known = drawn_pictures(minimum_.stereo) == plan_.eyes;
  pass(name, WorkMoment::picture, known ? plan_.eyes * strips() : 0, known ? plan_.eyes * pixels() : 0, reason,
       if_needed);
}

void PlanWriter::picture_pass(const std::string& name, const std::string& reason, bool if_needed) {
  pass(name, WorkMoment::picture, shown_, shown_ * pixels(), reason, if_needed);
}

}  // namespace ergodome
