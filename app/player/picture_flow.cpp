#include "app/player/picture_flow.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace ergodome {

namespace {

//! A picture may take this long while something moves: ten a second, with room for the rest of the machine.
constexpr double moving_budget_ms = 70.0;
constexpr int smallest_px = 192;

}  // namespace

bool PictureFlow::advance(const PictureRequest& wish, bool changed, bool moving) {
  pending_ = pending_ || changed;
  if (wish.renderer->backend() != Backend::cpu) {
    return advance_on_device(wish);
  }
  if (!source_) {
    source_ = std::make_unique<FrameSource>();
  }
  const bool answered = receive();
  if (!source_->idle()) {
    return answered;
  }
  if (pending_) {
    ask(wish, std::min(moving_size_px_, finest_px_));
  } else if (refining_ && report_.size_px < finest_px_ && !moving) {
    ask(wish, std::min(2 * report_.size_px, finest_px_));
  }
  return answered;
}

void PictureFlow::ask(PictureRequest wish, int size_px) {
  wish.size_px = size_px;
  pending_ = false;
  refining_ = false;
  source_->ask(wish);
}

bool PictureFlow::receive() {
  auto answer = source_->take();
  if (!answer) {
    return false;
  }
  report_.problem = answer->problem;
  if (!answer->problem.empty()) {
    return true;
  }
  // Where the camera is by now is still to be shown.
  pending_ = pending_ || answer->picture.behind;
  refining_ = true;
  // Time goes with the number of pixels; a damped step towards the width that fits.
  const double wished = answer->size_px * std::sqrt(moving_budget_ms / std::max(answer->time_ms, 1.0));
  moving_size_px_ =
      std::clamp(static_cast<int>(0.5 * (moving_size_px_ + wished)), std::min(smallest_px, finest_px_), finest_px_);
  report_.frame_time_ms = answer->time_ms;
  report_.size_px = answer->size_px;
  report_.lens = answer->picture.lens;
  report_.disparity = answer->disparity;
  ++report_.pictures;
  presenter_.upload(answer->picture);
  return true;
}

bool PictureFlow::advance_on_device(PictureRequest wish) {
  if (!pending_) {
    return false;
  }
  pending_ = false;
  wish.size_px = finest_px_;
  ShowRenderer& renderer = *wish.renderer;
  const auto start = std::chrono::steady_clock::now();
  try {
    if (eye_count(wish.stereo) < 2 && !renderer.finishes_pictures()) {
      renderer.set_stereo(wish.stereo);
      const Projection projection = make_projection(renderer.show().view, wish.size_px, wish.field_of_view_deg);
      const float* rgba =
          renderer.render_eye_in_place(wish.pose, 0.0, projection, wish.mode, wish.moment, &report_.lens);
      presenter_.upload_from_device(rgba, projection.width_px, projection.height_px, wish.mode != ViewMode::sky,
                                    tone_of(renderer.show().tone));
    } else {
      const Picture picture = render_for_window(wish);
      report_.lens = picture.lens;
      presenter_.upload(picture);
    }
  } catch (const std::exception& problem) {
    report_.problem = problem.what();
    return true;
  }
  report_.problem.clear();
  report_.frame_time_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  report_.size_px = finest_px_;
  ++report_.pictures;
  return true;
}

}  // namespace ergodome
