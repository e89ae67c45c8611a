#include "app/player/frame_source.h"

#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

#include "render/output/color_bar.h"

namespace ergodome {

using Clock = std::chrono::steady_clock;

//! What the thread and its owner share; the thread holds it, too, so that it may outlive the owner.
struct FrameSource::Worker {
  Render render;
  std::mutex mutex;
  std::condition_variable wake;
  std::optional<PictureRequest> request;
  std::optional<PictureAnswer> answer;
  std::optional<Clock::time_point> began;  //!< while a picture is in work
  bool ended = false;
  std::thread thread;

  void work();
};

namespace {

PictureAnswer answer_to(const FrameSource::Render& render, const PictureRequest& request) {
  const auto start = Clock::now();
  PictureAnswer answer;
  try {
    answer = render(request);
  } catch (const std::exception& problem) {
    answer.problem = problem.what();
  }
  answer.size_px = request.size_px;
  answer.time_ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  return answer;
}

}  // namespace

PictureAnswer render_for_window(const PictureRequest& request) {
  ShowRenderer& renderer = *request.renderer;
  const Projection projection = make_projection(renderer.show().view, request.size_px, request.field_of_view_deg);
  renderer.set_stereo(request.stereo);
  PictureAnswer answer;
  if (renderer.backend() != Backend::cpu && eye_count(request.stereo) < 2 && !renderer.finishes_pictures()) {
    const float* rgba =
        renderer.render_eye_in_place(request.pose, 0.0, projection, request.mode, request.moment, &answer.picture.lens);
    answer.on_device = {rgba, projection.width_px, projection.height_px, request.mode != ViewMode::sky,
                        tone_of(renderer.show().tone)};
  } else {
    answer.picture = renderer.render_window(request.pose, projection, request.mode, request.moment);
    draw_color_bar(answer.picture, request.mode);
  }
  if (request.disparity_asked) {
    answer.disparity = frame_disparity(renderer.show(), request.pose, projection);
  }
  return answer;
}

void FrameSource::Worker::work() {
  std::unique_lock lock(mutex);
  while (true) {
    wake.wait(lock, [this] { return ended || request.has_value(); });
    if (ended) {
      return;
    }
    const PictureRequest next = *std::exchange(request, std::nullopt);
    began = Clock::now();
    lock.unlock();
    PictureAnswer made = answer_to(render, next);
    lock.lock();
    answer = std::move(made);
    began.reset();
  }
}

namespace {

template <class Worker>
std::shared_ptr<Worker> started_worker(const FrameSource::Render& render) {
  auto worker = std::make_shared<Worker>();
  worker->render = render;
  worker->thread = std::thread([worker] { worker->work(); });
  return worker;
}

}  // namespace

FrameSource::FrameSource(Render render) : render_(std::move(render)), worker_(started_worker<Worker>(render_)) {}

FrameSource::~FrameSource() {
  {
    const std::lock_guard lock(worker_->mutex);
    worker_->ended = true;
  }
  worker_->wake.notify_all();
  worker_->thread.join();
}

bool FrameSource::idle() {
  const std::lock_guard lock(worker_->mutex);
  return !worker_->began && !worker_->request;
}

void FrameSource::ask(const PictureRequest& request) {
  {
    const std::lock_guard lock(worker_->mutex);
    worker_->request = request;
  }
  worker_->wake.notify_all();
}

std::optional<PictureAnswer> FrameSource::take() {
  const std::lock_guard lock(worker_->mutex);
  return std::exchange(worker_->answer, std::nullopt);
}

std::chrono::duration<double> FrameSource::working_for() {
  const std::lock_guard lock(worker_->mutex);
  return worker_->began ? Clock::now() - *worker_->began : Clock::duration::zero();
}

void FrameSource::abandon() {
  {
    const std::lock_guard lock(worker_->mutex);
    worker_->ended = true;
  }
  worker_->wake.notify_all();
  worker_->thread.detach();
  worker_ = started_worker<Worker>(render_);
}

}  // namespace ergodome
