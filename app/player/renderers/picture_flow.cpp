#include "app/player/renderers/picture_flow.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ergodome {

namespace {

//! Maximum time of a picture while something moves: ten per second, with time left for the rest of
//! the machine.
constexpr double moving_budget_ms = 70.0;

//! A picture has hung if it takes at least `min_hang_s`, and more than `hang_factor` times as
//! long as expected from the last one. The first picture, which also prepares data for later ones,
//! may take `first_hang_s`.
constexpr double min_hang_s = 1.5;
constexpr double first_hang_s = 60.0;
constexpr double hang_factor = 10.0;

}  // namespace

PictureNews PictureFlow::advance(const PictureRequest& wish, bool changed, bool moving) {
  pending_ = pending_ || changed;
  if (hangs()) {
    source_.abandon();
    ++report_.hangs;
    pending_ = true;
    report_.problem = "rendering a frame took too long and was aborted";
    return PictureNews::hang;
  }
  const PictureNews news = receive();
  if (!source_.idle() || held_) {
    return news;
  }
  const bool on_gpu = wish.renderer && wish.renderer->backend() != Backend::cpu;
  const bool whole = on_gpu && !(wish.output.frame_s > 0.0);
  budget_ms_ = on_gpu && !whole ? 1000.0 * wish.output.frame_s : moving_budget_ms;
  if (pending_) {
    if (!moving || !pace_ || pace_->is_due(now_())) {
      moving_size_px_ = std::max(moving_size_px_, wish.output.smallest_px);
      const int moving_px = hold_ ? hold_->size_px : whole ? finest_px_ : moving_size_px_;
      ask(wish, std::min(moving_px, finest_px_), moving);
    }
  } else if (refining_ && report_.size_px < finest_px_ && !moving) {
    ask(wish, std::min(2 * report_.size_px, finest_px_), false);
  }
  return news;
}

bool PictureFlow::hangs() {
  const double working_s = source_.working_for().count();
  if (working_s < min_hang_s) {
    return false;
  }
  if (report_.pictures == 0) {
    return working_s > first_hang_s;
  }
  const double growth = static_cast<double>(asked_size_px_) / std::max(report_.size_px, 1);
  return working_s > hang_factor * 1e-3 * report_.frame_time_ms * std::max(1.0, growth * growth);
}

void PictureFlow::hold(const PictureHold& hold) {
  if (!hold_ || hold_->frame_s != hold.frame_s) {
    pace_.emplace(hold.frame_s);
  }
  hold_ = hold;
}

void PictureFlow::note_interval() {
  const double now_s = now_();
  report_.interval_ms.reset();
  if (asked_moving_ && last_moving_s_) {
    report_.interval_ms = 1000.0 * (now_s - *last_moving_s_);
  }
  last_moving_s_ = asked_moving_ ? std::optional(now_s) : std::nullopt;
}

void PictureFlow::ask(PictureRequest wish, int size_px, bool moving) {
  if (pace_) {
    pace_->begin(now_());
  }
  asked_moving_ = moving;
  wish.size_px = size_px;
  wish.before = std::exchange(asked_position_, LensPosition{wish.frame.pose.r, wish.frame.pose.theta});
  asked_size_px_ = size_px;
  smallest_px_ = wish.output.smallest_px;
  pending_ = false;
  refining_ = false;
  if (gate_ != nullptr) {
    gate_->publish(wish);
  }
  source_.ask(wish);
}

PictureNews PictureFlow::receive() {
  if (!held_) {
    held_ = source_.take();
  }
  if (!held_ || (gate_ != nullptr && held_->problem.empty() && !gate_->release(*held_))) {
    return PictureNews::none;
  }
  std::optional<PictureAnswer> answer = std::exchange(held_, std::nullopt);
  report_.problem = answer->problem;
  if (!answer->problem.empty()) {
    return PictureNews::problem;
  }
  // If this picture shows an earlier camera position, because the lens for the current one is not
  // ready, the next picture is requested at once.
  pending_ = pending_ || answer->picture.behind;
  refining_ = true;
  // Time is proportional to the number of pixels. Takes a damped step toward the width that fits.
  const double wished = answer->size_px * std::sqrt(budget_ms_ / std::max(answer->time_ms, 1.0));
  moving_size_px_ =
      std::clamp(static_cast<int>(0.5 * (moving_size_px_ + wished)), std::min(smallest_px_, finest_px_), finest_px_);
  note_interval();
  report_.frame_time_ms = answer->time_ms;
  report_.errors_px = answer->errors_px;
  report_.size_px = answer->size_px;
  report_.lens = answer->picture.lens;
  report_.disparity = answer->disparity;
  report_.reduced = answer->reduced;
  report_.light = answer->light ? answer->light : report_.light;
  ++report_.pictures;
  show_(*answer);
  return PictureNews::picture;
}

}  // namespace ergodome
