#include "app/player.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/backend_choice.h"
#include "app/interrupt.h"
#include "app/lens_options.h"
#include "app/player_keys.h"
#include "app/setup_show.h"
#include "app/stereo_controls.h"
#include "render/output/image_writer.h"
#include "render/output/stereo_layout.h"

namespace ergodome {

namespace {

//! A picture may take this long while something moves: ten a second, with room for the rest of the machine.
constexpr double moving_budget_ms = 70.0;
constexpr int smallest_px = 192;

//! Size of the picture of a window; eyes that layouts keep apart are side by side there, and those of quad_buffer fill it.
ImageSize window_size(const Show& show, int size_px) {
  const Projection projection = make_projection(show.view, size_px, 0.0);
  const ImageSize eye = {projection.width_px, projection.height_px};
  const StereoLayout layout = show.stereo.layout;
  return layout == StereoLayout::quad_buffer
             ? eye
             : layout_size(keeps_eyes_apart(layout) ? StereoLayout::side_by_side : layout, eye);
}

}  // namespace

Player::Player(ShowRenderer& renderer, const PlayOptions& options)
    : renderer_(renderer),
      options_(options),
      window_(
          std::min(window_size(renderer.show(), options.size_px).width, options.setup ? 700 : 1600),
          std::min(window_size(renderer.show(), options.size_px).height, options.setup ? 700 : 1000), "Ergodome",
          options.full_screen,
          renderer.show().stereo.layout == StereoLayout::quad_buffer ? WindowBuffers::stereo : WindowBuffers::plain),
      flight_(renderer.show()),
      flying_(options.free_flight),
      times_shown_(options.times_shown),
      shown_stereo_(renderer.show().stereo),
      stereo_(shown_stereo_),
      field_of_view_deg_(renderer.show().view.field_of_view_deg) {
  if (options_.setup) {
    projectors_ =
        std::make_unique<ProjectorWindows>(window_, *options_.setup, options_.projectors, options_.hide_control);
  }
  if (stereo_.layout == StereoLayout::quad_buffer && window_.buffers() == WindowBuffers::plain) {
    fmt::print(stderr, "ergodome: this driver has no buffers for each eye; the eyes are side by side\n");
    stereo_.layout = StereoLayout::side_by_side;
  }
  if (renderer.backend() == Backend::cpu) {
    source_ = std::make_unique<FrameSource>(renderer);
  }
}

Player::~Player() = default;

CameraPose Player::current_pose() const {
  return flying_ ? flight_.pose() : camera_pose(renderer_.show(), show_time_s_);
}

ShowMoment Player::moment() const {
  // A seek shows something soon, streamed or not, and a grid that takes longer is for the next picture.
  constexpr double patience_s = 0.02;
  return {flying_ ? std::nullopt : std::optional(show_time_s_), patience_s};
}

bool Player::moving() const {
  const bool playing = !flying_ && !paused_ && renderer_.show().duration_s > 0.0;
  return changed_ || !held_keys_.empty() || playing;
}

void Player::run() {
  auto last = Clock::now();
  while (!closed() && !interrupted()) {
    for (const WindowEvent& event : events()) {
      handle(event);
    }
    const auto now = Clock::now();
    advance(std::chrono::duration<double>(now - last).count());
    last = now;
    if (source_) {
      receive();
      ask_for_picture();
    } else {
      show_on_device();
    }
    draw();
    if (options_.for_seconds > 0.0 && first_answer_ &&
        std::chrono::duration<double>(now - *first_answer_).count() >= options_.for_seconds) {
      window_.close();
    }
  }
  if (options_.for_seconds > 0.0 && pictures_ > 0) {
    fmt::print("{} pictures after the first in {:.1f} s\n", pictures_ - 1, options_.for_seconds);
  }
  if (const auto streamed = renderer_.stream_statistics(); streamed && options_.for_seconds > 0.0) {
    print_statistics(*streamed);
  }
  if (!options_.screenshot.empty()) {
    save_screenshot();
  }
}

bool Player::closed() const { return window_.closed() || (projectors_ && projectors_->closed()); }

std::vector<WindowEvent> Player::events() {
  std::vector<WindowEvent> all = window_.events(0.004);
  if (projectors_) {
    const std::vector<WindowEvent> others = projectors_->events();
    all.insert(all.end(), others.begin(), others.end());
  }
  return all;
}

void Player::save_screenshot() {
  if (projectors_) {
    projectors_->save_screenshots(options_.screenshot, plain_names(*options_.setup));
  }
  int width = 0;
  int height = 0;
  window_.framebuffer_size(width, height);
  if (width > 0 && height > 0) {
    draw_window(width, height);
    write_png(options_.screenshot, Presenter::read_back(width, height), width, height);
  }
}

void Player::handle(const WindowEvent& event) {
  switch (event.kind) {
    case WindowEvent::Kind::key_down:
      held_keys_.insert(event.key);
      press(event.key);
      break;
    case WindowEvent::Kind::key_up:
      held_keys_.erase(event.key);
      break;
    case WindowEvent::Kind::drag: {
      if (!flying_) {
        flight_.start_at(current_pose());
        flying_ = true;
      }
      int width = 0;
      int height = 0;
      window_.framebuffer_size(width, height);
      const double radians_per_px = field_of_view_deg_ / 57.29577951308232 / std::max(width, 1);
      flight_.look(-event.dx * radians_per_px, event.dy * radians_per_px);
      break;
    }
    case WindowEvent::Kind::scroll:
      field_of_view_deg_ = std::clamp(field_of_view_deg_ * std::exp(-0.1 * event.dy), 0.01,
                                      renderer_.show().view.projection == ViewProjection::pinhole ? 170.0 : 360.0);
      break;
  }
  changed_ = true;
}

void Player::press(int key) {
  const double duration_s = renderer_.show().duration_s;
  switch (action_of(key)) {
    case KeyAction::quit:
      window_.close();
      break;
    case KeyAction::pause:
      paused_ = !paused_;
      break;
    case KeyAction::seek_back:
      show_time_s_ = std::max(0.0, show_time_s_ - 2.0);
      break;
    case KeyAction::seek_forward:
      show_time_s_ = std::min(duration_s, show_time_s_ + 2.0);
      break;
    case KeyAction::restart:
      show_time_s_ = 0.0;
      flying_ = false;
      break;
    case KeyAction::fly:
      flight_.start_at(current_pose());
      flying_ = !flying_;
      break;
    case KeyAction::full_screen:
      window_.toggle_full_screen();
      break;
    case KeyAction::times:
      times_shown_ = !times_shown_;
      break;
    case KeyAction::next_view:
      mode_ = static_cast<ViewMode>((static_cast<int>(mode_) + 1) % 6);
      break;
    default:
      if (!projectors_) {  // what a dome's projectors show is one eye's
        stereo_ = adjusted(stereo_, action_of(key), shown_stereo_, current_pose().r);
      }
      break;
  }
}

void Player::advance(double seconds) {
  const auto held = [&](KeyAction action) {
    return std::any_of(held_keys_.begin(), held_keys_.end(), [&](int key) { return action_of(key) == action; }) ? 1.0
                                                                                                                : 0.0;
  };
  const double speed = 0.6 * std::min(seconds, 0.1);
  const double phi = held(KeyAction::right) - held(KeyAction::left);
  const double theta = held(KeyAction::down) - held(KeyAction::up);
  const double out = held(KeyAction::out) - held(KeyAction::in);
  if (phi != 0.0 || theta != 0.0 || out != 0.0) {
    if (!flying_) {
      flight_.start_at(current_pose());
      flying_ = true;
    }
    flight_.orbit(speed * phi, speed * theta, std::exp(speed * out));
    changed_ = true;
  }
  const double duration_s = renderer_.show().duration_s;
  if (!flying_ && !paused_ && duration_s > 0.0) {
    // The show loops; taking the rest keeps the time exact for as long as an exhibit runs.
    show_time_s_ = std::fmod(show_time_s_ + seconds, duration_s);
    changed_ = true;
  }
}

void Player::ask_for_picture() {
  if (!source_->idle()) {
    return;
  }
  if (changed_) {
    refined_size_px_ = 0;
    source_->ask({current_pose(), mode_, field_of_view_deg_, std::min(moving_size_px_, options_.size_px), moment(),
                  stereo_, times_shown_});
    changed_ = false;
  } else if (refined_size_px_ > 0 && refined_size_px_ < options_.size_px && !moving()) {
    const int finer = std::min(2 * refined_size_px_, options_.size_px);
    refined_size_px_ = 0;
    source_->ask({current_pose(), mode_, field_of_view_deg_, finer, moment(), stereo_, times_shown_});
  }
}

void Player::receive() {
  auto answer = source_->take();
  if (!answer) {
    return;
  }
  note_answer();
  if (!answer->problem.empty()) {
    if (answer->problem != said_problem_) {
      said_problem_ = answer->problem;
      fmt::print(stderr, "ergodome: {}\n", answer->problem);
    }
    return;
  }
  frame_time_ms_ = answer->time_ms;
  refined_size_px_ = answer->size_px;
  ++pictures_;
  // Where the camera is by now is still to be shown.
  changed_ = changed_ || answer->picture.behind;
  // Time goes with the number of pixels; a damped step towards the width that fits.
  const double wished = answer->size_px * std::sqrt(moving_budget_ms / std::max(answer->time_ms, 1.0));
  moving_size_px_ = std::clamp(static_cast<int>(0.5 * (moving_size_px_ + wished)),
                               std::min(smallest_px, options_.size_px), options_.size_px);
  lens_ = answer->picture.lens;
  write_panel(answer->size_px, answer->disparity);
  presenter_.upload(answer->picture);
  update_title();
}

void Player::show_on_device() {
  if (!changed_) {
    return;
  }
  changed_ = false;
  const auto start = Clock::now();
  const Projection projection = make_projection(renderer_.show().view, options_.size_px, field_of_view_deg_);
  renderer_.set_stereo(stereo_);
  if (eye_count(stereo_) < 2 && !renderer_.finishes_pictures()) {
    const float* rgba = renderer_.render_eye_in_place(current_pose(), 0.0, projection, mode_, moment(), &lens_);
    presenter_.upload_from_device(rgba, projection.width_px, projection.height_px, mode_ != ViewMode::sky,
                                  tone_of(renderer_.show().tone));
  } else {
    const Picture picture = renderer_.render_window(current_pose(), projection, mode_, moment());
    lens_ = picture.lens;
    presenter_.upload(picture);
  }
  frame_time_ms_ = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  write_panel(options_.size_px, std::nullopt);
  ++pictures_;
  note_answer();
  update_title();
}

void Player::write_panel(int size_px, const std::optional<Disparity>& disparity) {
  if (!times_shown_) {
    return;
  }
  std::string text =
      fmt::format("{:.1f} ms at {} px, {} lens, {}", frame_time_ms_, size_px, lens_, describe(renderer_.backend()));
  if (eye_count(stereo_) > 1) {
    text += "\n" + disparity_caption(stereo_, disparity);
  }
  int width = 0;
  int height = 0;
  window_.framebuffer_size(width, height);
  panel_.set(text, std::clamp(std::min(width, height) / 50, 11, 36));
}

void Player::note_answer() {
  if (!first_answer_) {
    first_answer_ = Clock::now();
  }
}

void Player::draw_window(int width, int height) {
  const auto draw_panel = [&] {
    if (times_shown_) {
      panel_.draw(width, height, PanelPlace::top_left);
    }
  };
  if (stereo_.layout == StereoLayout::quad_buffer) {
    window_.draw_into(WindowEye::left);
    presenter_.draw(width, height, PicturePart::left_half);
    draw_panel();
    window_.draw_into(WindowEye::right);
    presenter_.draw(width, height, PicturePart::right_half);
  } else {
    window_.draw_into(WindowEye::both);
    presenter_.draw(width, height);
  }
  draw_panel();
}

void Player::draw() {
  if (projectors_) {
    projectors_->show(presenter_.shown());
    if (!projectors_->control_shown()) {
      return;
    }
  }
  int width = 0;
  int height = 0;
  window_.framebuffer_size(width, height);
  draw_window(width, height);
  window_.swap();
}

void Player::update_title() {
  const CameraPose pose = current_pose();
  window_.set_title(fmt::format("Ergodome  {}  a {:.6g}  r {:.4g} M  {:.1f} s  {:.1f} ms at {} px  {} lens  {}{}",
                                renderer_.show().title, renderer_.show().spin, pose.r, show_time_s_, frame_time_ms_,
                                refined_size_px_ > 0 ? refined_size_px_ : options_.size_px, lens_,
                                describe(renderer_.backend()),
                                flying_   ? "  free flight"
                                : paused_ ? "  paused"
                                          : ""));
}

}  // namespace ergodome
