#include "app/player/renderers/frame_source.h"

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

#include "app/player/renderers/picture_error.h"
#include "app/player/renderers/picture_light.h"
#include "kernels/projection/make_projection.h"
#include "render/output/color_bar.h"
#include "render/output/stereo_layout.h"
#include "render/present/headset/head_motion.h"

namespace ergodome {

using Clock = std::chrono::steady_clock;

//! State shared by the thread and its owner. The thread holds it too, so the state may outlive the
//! owner.
struct FrameSource::Worker {
  Render render;
  std::mutex mutex;
  std::condition_variable wake;
  std::optional<PictureRequest> request;
  std::optional<PictureAnswer> answer;
  std::optional<Clock::time_point> began;  //!< start of the picture being rendered, if any
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
  answer.time_ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count() - answer.measuring_ms;
  return answer;
}

}  // namespace

namespace {

//! Maximum width of a caption layer for projectors [px]. Drawing it takes 16 bytes per pixel.
constexpr int widest_master_captions_px = 4096;

//! Returns the width of the caption layer for projectors. Returns 0 if they need none, because the
//! domemaster is as fine as they are and contains its captions.
int projectors_caption_px(const PictureRequest& request) {
  const int width_px = std::min(request.output.projectors_px, widest_master_captions_px);
  return width_px > request.size_px ? width_px : 0;
}

//! Sets up a show's renderer for a frame.
void set_up(ShowRenderer& renderer, const PictureRequest& request) {
  const PlayerFrame& frame = request.frame;
  renderer.apply(frame.time_s);
  renderer.set_observer(frame.observer.motion, frame.observer.velocity);
  renderer.set_exposure(frame.exposure_stops);
  renderer.set_stereo(frame.stereo);
  renderer.set_stars_apart(request.output.star_pixel);
  if (request.quality) {
    FrameQuality quality = *request.quality;
    quality.budget_px *= static_cast<double>(request.size_px) / request.whole_px;
    renderer.set_quality(quality);
  }
  // Exposure does not adapt before a time that no clock reaches, and completely after one long ago.
  constexpr double never_s = 1e12;
  if (request.followed_stops) {
    renderer.follow_from(*request.followed_stops, never_s);
  } else if (request.adapts_at_once) {
    renderer.follow_from(0.0, -never_s);
  }
  OverlayPass& overlays = renderer.overlays();
  overlays.set_language(frame.language);
  overlays.set_captions(frame.captions);
  overlays.set_captions_apart(request.output.window || request.output.caption_panel ||
                              projectors_caption_px(request) > 0);
  overlays.set_extra(request.captions, request.captions_opacity);
}

//! Returns the pose of a viewer's head at an observer. `scale_per_m`: length in the scene of a meter
//! in the viewer's room [M].
CameraPose head_pose(const Show& show, const CameraPose& observer, const ViewerHead& head, double scale_per_m) {
  CameraPose pose = observer;
  pose.orientation = key_orientation(CameraKey());
  const glm::dvec3 offset = scale_per_m * head.offset_m;
  if (glm::length(offset) > 0.0) {
    pose = moved_head(show, pose, {offset.x, offset.y, offset.z});
  }
  pose.orientation = glm::normalize(pose.orientation * head.turn);
  return pose;
}

EyesInWindow eyes_in_window(StereoLayout layout) {
  return !fills_window_by_eye(layout)          ? EyesInWindow::as_one
         : layout == StereoLayout::quad_buffer ? EyesInWindow::in_buffers
                                               : EyesInWindow::in_rows;
}

//! Returns the width of an eye's captions at which they have at least one pixel per window pixel in
//! both directions [px].
int caption_width_px(const ImageSize& window, StereoLayout layout, const Projection& eye) {
  constexpr double widest_px = 8192.0;
  const EyeGrid grid = eye_grid(layout);
  const ImageSize whole = window_picture_size(layout, {eye.width_px, eye.height_px});
  const double scale =
      std::min(static_cast<double>(window.width) / whole.width, static_cast<double>(window.height) / whole.height);
  const double across = scale * whole.width / grid.columns;
  const double along = scale * whole.height / grid.rows * eye.width_px / eye.height_px;
  return static_cast<int>(std::lround(std::clamp(std::max(across, along), 1.0, widest_px)));
}

//! Renders the eyes for a window. In the view of the sky they stay separate pictures, because
//! joining would copy both of them. The eyes of a heat map are joined and share a color bar, except
//! if each eye fills the window.
void show_eyes(ShowRenderer& renderer, const PlayerFrame& frame, const Projection& projection, const ShowMoment& moment,
               PictureAnswer& answer) {
  if (frame.mode != ViewMode::sky && !fills_window_by_eye(frame.stereo.layout)) {
    answer.picture = renderer.render_window(frame.pose, projection, frame.mode, moment);
    draw_color_bar(answer.picture, frame.mode);
    return;
  }
  std::vector<Picture> parts = renderer.render_window_parts(frame.pose, projection, frame.mode, moment);
  for (Picture& part : parts) {
    draw_color_bar(part, frame.mode);
  }
  answer.picture = std::move(parts.front());
  if (parts.size() > 1) {
    answer.picture.behind = answer.picture.behind || parts[1].behind;
    answer.right_eye = std::move(parts[1]);
    answer.eyes_above = frame.stereo.layout == StereoLayout::top_bottom;
  }
}

//! Renders eyes whose views the output defines. They get neither overlays nor automatic exposure.
void show_own_eyes(ShowRenderer& renderer, const PictureRequest& request, const ShowMoment& moment,
                   PictureAnswer& answer) {
  const auto picture_of = [&](const OutputEye& eye) {
    CameraPose pose = request.frame.pose;
    pose.orientation = pose.orientation * eye.turn;
    const double offset = eye.side * renderer.show().stereo.baseline;
    Picture picture = renderer.render_eye(pose, offset, eye.projection, request.frame.mode, moment);
    picture.tone = renderer.tone();
    return picture;
  };
  const std::vector<OutputEye>& eyes = request.output.eyes;
  answer.picture = picture_of(eyes.front());
  if (eyes.size() > 1) {
    answer.right_eye = picture_of(eyes.back());
    answer.picture.behind = answer.picture.behind || answer.right_eye->behind;
  }
}

//! Renders one or two eyes into pictures that stay in GPU memory.
void show_in_place(ShowRenderer& renderer, const PlayerFrame& frame, const Projection& projection,
                   const ShowMoment& moment, PictureAnswer& answer) {
  const BackendEyes eyes = renderer.render_eyes_in_place(frame.pose, projection, frame.mode, moment);
  answer.picture.lens = eyes.first.lens;
  answer.picture.behind = eyes.first.behind || (eyes.right && eyes.right->behind);
  answer.on_device = {eyes.first.rgba,
                      eyes.right ? eyes.right->rgba : nullptr,
                      frame.stereo.layout == StereoLayout::top_bottom,
                      projection.width_px,
                      projection.height_px,
                      frame.mode != ViewMode::sky,
                      renderer.tone(),
                      eyes.first.stars,
                      eyes.right ? eyes.right->stars : nullptr};
}

//! Renders the eyes of the show's stereo settings, and the captions over them.
void show_eyes_of_show(ShowRenderer& renderer, const PictureRequest& request, const Projection& projection,
                       const ShowMoment& moment, PictureAnswer& answer) {
  const PlayerFrame& frame = request.frame;
  const StereoLayout layout = frame.stereo.layout;
  answer.eyes = eyes_in_window(layout);
  answer.eye_grid = eye_grid(layout);
  if (renderer.may_stay_in_place(frame.mode)) {
    show_in_place(renderer, frame, projection, moment, answer);
  } else {
    show_eyes(renderer, frame, projection, moment, answer);
  }
  if (const std::optional<CaptionPanel>& panel = request.output.caption_panel) {
    const double fov = 2.0 * std::atan(panel->half_width);
    answer.captions = renderer.caption_layer(make_pinhole_projection(panel->size.width, panel->size.height, fov),
                                             frame.mode, frame.time_s);
    return;
  }
  const std::optional<ImageSize>& window = request.output.window;
  const int width_px = window ? caption_width_px(*window, layout, projection) : projectors_caption_px(request);
  if (width_px > 0) {
    answer.captions = renderer.caption_layer(make_projection(renderer.show().view, width_px, frame.field_of_view_deg),
                                             frame.mode, frame.time_s);
  }
}

//! Renders a request whose renderer is set up.
PictureAnswer render_request(const PictureRequest& request) {
  ShowRenderer& renderer = *request.renderer;
  const PlayerFrame& frame = request.frame;
  const Projection projection = make_projection(renderer.show().view, request.size_px, frame.field_of_view_deg);
  // A picture waits for its lens for at most patience_s, so that it appears soon after a seek. A
  // grid that takes longer is used by the next picture.
  const ShowMoment moment = {frame.path_time_s, request.patience_s, request.before, request.alike};
  PictureAnswer answer;
  if (request.light_asked_s) {
    const auto begun = Clock::now();
    // Measured before the picture, which may stay in the renderer's memory.
    answer.light = ViewLight{*request.light_asked_s, lit_part_of_view(renderer, request, moment)};
    answer.measuring_ms += std::chrono::duration<double, std::milli>(Clock::now() - begun).count();
  }
  if (request.output.eyes.empty()) {
    show_eyes_of_show(renderer, request, projection, moment, answer);
  } else {
    show_own_eyes(renderer, request, moment, answer);
  }
  answer.reduced = renderer.reduced_baseline();
  answer.followed_stops = renderer.followed_stops();
  if (request.errors_asked) {
    const auto begun = Clock::now();
    answer.errors_px = picture_errors(renderer, request, projection, moment);
    answer.measuring_ms += std::chrono::duration<double, std::milli>(Clock::now() - begun).count();
  }
  if (request.disparity_asked) {
    Show shown = renderer.show();
    shown.stereo.baseline = answer.reduced ? answer.reduced->baseline : shown.stereo.baseline;
    answer.disparity =
        frame_disparity(shown, frame.pose, projection, renderer.object_outlines(), renderer.hiding_objects());
  }
  return answer;
}

}  // namespace

PictureAnswer render_for_output(const PictureRequest& request) {
  if (request.pattern) {
    PictureAnswer answer;
    answer.picture = request.pattern(request.size_px);
    return answer;
  }
  ShowRenderer& renderer = *request.renderer;
  set_up(renderer, request);
  if (!request.output.head) {
    return render_request(request);
  }
  // Baked lenses are only for positions on the path, so a head moves off it only without them.
  const double scale = renderer.stream_statistics() ? 0.0 : request.scale_per_m;
  PictureRequest placed = request;
  placed.frame.pose = head_pose(renderer.show(), request.frame.pose, *request.output.head, scale);
  PictureAnswer answer = render_request(placed);
  answer.turn = request.output.head->turn;
  answer.observer = request.frame.pose;
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
  return !worker_->began && !worker_->request && !worker_->answer;
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
