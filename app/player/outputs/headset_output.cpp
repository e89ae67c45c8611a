#include "app/player/outputs/headset_output.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>
#include <utility>

#include "app/budget/deadline.h"
#include "kernels/core/angles.h"
#include "kernels/core/error.h"
#include "kernels/projection/cube_faces.h"
#include "render/opengl/headless_context.h"
#include "render/output/image_writer.h"

namespace ergodome {

namespace {

//! Height of the eyes of a standing viewer, where the room's origin is a head at rest [m].
constexpr double eye_height_m = 1.6;
constexpr double usual_eye_distance_m = 0.063;
//! Time between attempts to find a lost headset.
constexpr double search_again_s = 1.0;
//! Time between pictures of the mirror, so that the headset gets most of the machine.
constexpr double mirror_s = 0.033;
//! Turn of the head after which the eyes of a stereo model get pictures for their new positions.
constexpr double turn_step_rad = 15.0 * one_degree;
//! Width of one of the cube's faces below which pictures are not made coarser [px].
constexpr int smallest_face_px = 160;
constexpr int largest_face_px = 4096;

glm::dquat about_up(double angle) { return glm::angleAxis(angle, glm::dvec3(0.0, 1.0, 0.0)); }

//! Returns the direction of a view, to the left of the room's front [rad]; that of its upper side
//! if it looks straight down, and of its lower side if straight up.
double heading_of(const glm::dquat& turn) {
  glm::dvec3 forward = turn * glm::dvec3(0.0, 0.0, -1.0);
  if (std::abs(forward.y) > 0.99) {
    forward = turn * glm::dvec3(0.0, forward.y < 0.0 ? 1.0 : -1.0, 0.0);
  }
  return std::atan2(-forward.x, -forward.z);
}

glm::dquat head_turn(const HeadsetEyes& eyes) { return glm::slerp(eyes[0].turn, eyes[1].turn, 0.5); }
glm::dvec3 head_position_m(const HeadsetEyes& eyes) { return 0.5 * (eyes[0].position_m + eyes[1].position_m); }

//! Returns the view of a viewer who stands in the middle and looks ahead, for the mirror before
//! there is a headset.
HeadsetEyes standing_eyes() {
  HeadsetEyes eyes;
  for (HeadsetEye& eye : eyes) {
    eye.position_m = {0.0, eye_height_m, 0.0};
  }
  return eyes;
}

}  // namespace

HeadsetOutput::HeadsetOutput(const HeadsetOptions& options)
    : options_(options),
      window_(std::min(options.mirror.size.width, options.mirror.largest.width),
              std::min(options.mirror.size.height, options.mirror.largest.height), "Ergodome",
              options.mirror.full_screen),
      eyes_(standing_eyes()),
      advanced_s_(steady_seconds()) {
  // An obscured window that waits for its refresh would slow down the headset.
  window_.swap_at_once();
  glCreateFramebuffers(1, &framebuffer_);
  try {
    session_.emplace();
  } catch (const HeadsetLost& problem) {
    if (!options.may_be_absent) {
      throw Error("headset", problem.what(), "restart the OpenXR runtime");
    }
    lose(problem.what());
  } catch (const std::exception& problem) {
    if (!options.may_be_absent) {
      throw;
    }
    lose(problem.what());
  }
}

HeadsetOutput::~HeadsetOutput() { glDeleteFramebuffers(1, &framebuffer_); }

void HeadsetOutput::lose(const std::string& problem) {
  problem_ = problem;
  frame_.reset();
  session_.reset();
  next_try_s_ = steady_seconds() + search_again_s;
}

void HeadsetOutput::connect() {
  if (session_ || steady_seconds() < next_try_s_) {
    return;
  }
  try {
    session_.emplace();
    problem_.clear();
    recenter();
  } catch (const std::exception& problem) {
    lose(problem.what());
  }
}

template <class Work>
void HeadsetOutput::with_session(const Work& work) {
  try {
    work(*session_);
  } catch (const HeadsetLost& problem) {
    lose(problem.what());
  }
}

OutputWish HeadsetOutput::wish() {
  connect();
  if (session_) {
    with_session([&](HeadsetSession& session) {
      session.poll();
      if (session.take_recentered()) {
        recenter();
      }
      if (session.state() != HeadsetState::ended) {
        frame_ = session.begin_frame();
      } else if (options_.may_be_absent) {
        throw HeadsetLost("the session was ended from the runtime's menu");
      }
    });
  }
  if (!frame_) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  OutputWish wish;
  wish.display_delay_s = frame_ ? frame_->delay_s : 0.0;
  wish.frame_s = frame_ ? frame_->period_s : 0.0;
  wish.smallest_px = cube_faces * smallest_face_px;
  // Views of most headsets are about as wide as a face of the cube.
  wish.star_pixel = 2.0 / std::max(session_ ? session_->eye_size().width : size().width, smallest_face_px);
  wish.caption_panel = CaptionPanel{{caption_panel_px, static_cast<int>(caption_panel_px / caption_panel_aspect)},
                                    caption_panel_half_width};
  ViewerHead& head = wish.head.emplace();
  head.look = level_from_room() * head_turn(eyes_);
  head.offset_m = level_from_room() * (head_position_m(eyes_) - middle_m_);
  const double distance_m = glm::length(eyes_[1].position_m - eyes_[0].position_m);
  // Rounded, so that the noise of tracking causes no new pictures.
  head.eye_distance_m = distance_m > 0.0 ? 5e-4 * std::round(distance_m / 5e-4) : usual_eye_distance_m;
  const HeadsetStereo stereo = settings_.stereo;
  if (stereo == HeadsetStereo::flat || stereo == HeadsetStereo::physical) {
    const double heading = heading_of(head.look);
    if (std::abs(std::remainder(heading - turn_step_, full_turn)) > turn_step_rad) {
      turn_step_ = heading;
    }
    head.turn = about_up(turn_step_);
  }
  return wish;
}

void HeadsetOutput::take(OutputFrame& frame) {
  panorama_.set(frame);
  painter_.set_captions(frame.captions);
  motion_.note(frame, steady_seconds());
}

glm::dquat HeadsetOutput::level_from_room() const { return about_up(first_yaw_ - comfort_state_.yaw_rad - facing_); }

void HeadsetOutput::set_headset(const HeadsetSettings& settings) {
  settings_ = settings;
  comfort_.change(settings);
}

void HeadsetOutput::turn_viewer(double rate) {
  turn_rate_ = rate;
  snap_steps_ += snap_turns_.turn(rate);
}

std::optional<HeadsetHands> HeadsetOutput::hands() {
  HeadsetHands hands;
  if (session_) {
    with_session([&](HeadsetSession& session) { hands = session.hands(); });
  }
  const bool menu = hands[0].menu || hands[1].menu;
  if (menu && !std::exchange(menu_held_, menu)) {
    recenter();
  }
  menu_held_ = menu;
  return hands;
}

void HeadsetOutput::pulse(double seconds, double strength) {
  if (session_) {
    with_session([&](HeadsetSession& session) {
      session.pulse(0, seconds, strength);
      session.pulse(1, seconds, strength);
    });
  }
}

void HeadsetOutput::follow_head() {
  located_ = true;
  if (!centered_) {
    centered_ = true;
    middle_m_ = head_position_m(eyes_);
    facing_ = heading_of(head_turn(eyes_));
    first_yaw_ = comfort_state_.yaw_rad;
  }
}

HeadsetScene HeadsetOutput::scene() const {
  HeadsetScene scene;
  scene.level_from_room = level_from_room();
  scene.light = light_ * comfort_state_.light;
  scene.exposure_stops = comfort_state_.exposure_stops - std::log2(std::max(panorama_.tone().gain, 1e-30F));
  scene.rest_frame = settings_.rest_frame;
  scene.floor_m = session_ && session_->origin() == HeadsetOrigin::head ? -eye_height_m : 0.0;
  scene.middle_m = middle_m_;
  scene.facing_rad = facing_;
  scene.vignette = comfort_state_.vignette;
  scene.clear_half_angle_rad = comfort_state_.clear_half_angle_rad;
  scene.panels = settings_.panel;
  return scene;
}

void HeadsetOutput::draw_frame() {
  with_session([&](HeadsetSession& session) {
    const std::optional<HeadsetEyes> eyes = session.locate();
    if (eyes) {
      eyes_ = *eyes;
      follow_head();
    }
    const bool drawn = eyes && frame_->drawn;
    const HeadsetScene now = scene();
    for (int eye = 0; drawn && eye < 2; ++eye) {
      const unsigned texture = session.begin_eye(eye);
      glNamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, texture, 0);
      glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
      painter_.draw(panorama_, eye, eyes_[static_cast<std::size_t>(eye)], now, session.eye_size(), session.encoded());
      glBindFramebuffer(GL_FRAMEBUFFER, 0);
      glNamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, 0, 0);
      session.end_eye(eye);
    }
    frame_.reset();
    session.end_frame(drawn ? eyes : std::nullopt);
  });
}

void HeadsetOutput::draw_mirror() {
  const ImageSize now = size();
  if (now.width == 0 || now.height == 0) {
    return;
  }
  // The left eye's view with the window's shape.
  HeadsetEye view = eyes_[0];
  const double aspect = static_cast<double>(now.width) / now.height;
  view.sides = {-aspect, aspect, 1.0, -1.0};
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  painter_.draw(panorama_, 0, view, scene(), now, true);
}

void HeadsetOutput::show() {
  const double now_s = steady_seconds();
  const double stops = std::log2(std::max(panorama_.tone().gain, 1e-30F));
  comfort_state_ =
      comfort_.advance(now_s - advanced_s_, {.speed = motion_.speed(now_s),
                                             .cut = motion_.take_cut(),
                                             .snap_turn = static_cast<double>(std::exchange(snap_steps_, 0)),
                                             .smooth_turn = turn_rate_,
                                             .exposure_stops = stops});
  advanced_s_ = now_s;
  if (frame_ && session_) {
    draw_frame();
  }
  if (now_s - mirrored_s_ >= mirror_s) {
    mirrored_s_ = now_s;
    draw_mirror();
    window_.swap();
  }
}

bool HeadsetOutput::closed() const {
  return window_.closed() || (!options_.may_be_absent && session_ && session_->state() == HeadsetState::ended);
}

std::vector<WindowEvent> HeadsetOutput::events() { return window_.events(0.0); }

ImageSize HeadsetOutput::size() const {
  ImageSize size = {0, 0};
  window_.framebuffer_size(size.width, size.height);
  return size;
}

void HeadsetOutput::set_text(PanelPosition position, const std::string& text) {
  texts_[position] = text;
  const std::string& help = texts_[PanelPosition::middle];
  const std::string& times = texts_[PanelPosition::top_left];
  const std::string& message = texts_[PanelPosition::bottom_middle];
  painter_.set_text(!help.empty() ? help : times.empty() || message.empty() ? times + message : times + "\n" + message);
}

void HeadsetOutput::save_screenshot(const std::string& file) {
  if (const ImageSize now = size(); now.width > 0 && now.height > 0) {
    draw_mirror();
    write_png(file, read_framebuffer(now.width, now.height), now.width, now.height);
  }
}

int HeadsetOutput::fitting_size_px() const {
  if (!session_) {
    return cube_faces * smallest_face_px;
  }
  // A face of the cube shows tangents from -1 to 1. So do, roughly, the views of most headsets,
  // whose sides are known only with the first frame.
  const int face_px = std::clamp(session_->eye_size().width, smallest_face_px, largest_face_px);
  return cube_faces * face_px;
}

bool HeadsetOutput::attended() const {
  // Before its first frame a headset is being started, and without one the window is watched.
  return !session_ || !located_ || session_->state() == HeadsetState::visible ||
         session_->state() == HeadsetState::focused;
}

std::string HeadsetOutput::state_text() const {
  if (!session_) {
    return problem_;
  }
  constexpr const char* names[] = {"waiting", "not worn", "visible, without input", "in use", "ended by its user"};
  return fmt::format("{}: {}", session_->name(), names[static_cast<int>(session_->state())]);
}

}  // namespace ergodome
