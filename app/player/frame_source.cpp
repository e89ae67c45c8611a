#include "app/player/frame_source.h"

#include <chrono>
#include <exception>
#include <utility>

#include "render/output/color_bar.h"

namespace ergodome {

Picture render_for_window(const PictureRequest& request) {
  ShowRenderer& renderer = *request.renderer;
  const Projection projection = make_projection(renderer.show().view, request.size_px, request.field_of_view_deg);
  renderer.set_stereo(request.stereo);
  Picture picture = renderer.render_window(request.pose, projection, request.mode, request.moment);
  draw_color_bar(picture, request.mode);
  return picture;
}

namespace {

PictureAnswer answer_to(const PictureRequest& request) {
  PictureAnswer answer;
  answer.size_px = request.size_px;
  const auto start = std::chrono::steady_clock::now();
  try {
    answer.picture = render_for_window(request);
    if (request.disparity_asked) {
      const Show& show = request.renderer->show();
      answer.disparity =
          frame_disparity(show, request.pose, make_projection(show.view, request.size_px, request.field_of_view_deg));
    }
  } catch (const std::exception& problem) {
    answer.problem = problem.what();
  }
  answer.time_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return answer;
}

}  // namespace

FrameSource::FrameSource() : thread_([this](const std::stop_token& stop) { work(stop); }) {}

FrameSource::~FrameSource() {
  thread_.request_stop();
  wake_.notify_all();
}

bool FrameSource::idle() {
  const std::lock_guard lock(mutex_);
  return !busy_ && !request_;
}

void FrameSource::ask(const PictureRequest& request) {
  {
    const std::lock_guard lock(mutex_);
    request_ = request;
  }
  wake_.notify_all();
}

std::optional<PictureAnswer> FrameSource::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(answer_, std::nullopt);
}

void FrameSource::work(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (wake_.wait(lock, stop, [this] { return request_.has_value(); })) {
    const PictureRequest request = *std::exchange(request_, std::nullopt);
    busy_ = true;
    lock.unlock();
    PictureAnswer answer = answer_to(request);
    lock.lock();
    answer_ = std::move(answer);
    busy_ = false;
  }
}

}  // namespace ergodome
