#include "app/player/player.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "app/backend_choice.h"
#include "app/interrupt.h"
#include "app/lens_options.h"
#include "app/stereo_controls.h"
#include "render/output/stereo_layout.h"

namespace ergodome {

namespace {

//! The window for pictures of a show; eyes that layouts keep apart are side by side there, and those of quad_buffer fill it.
ScreenOptions screen_options(const Show& show, const PlayOptions& options) {
  const Projection projection = make_projection(show.view, options.size_px, 0.0);
  const ImageSize eye = {projection.width_px, projection.height_px};
  const StereoLayout layout = show.stereo.layout;
  const bool eye_buffers = layout == StereoLayout::quad_buffer;
  const ImageSize size =
      eye_buffers ? eye : layout_size(keeps_eyes_apart(layout) ? StereoLayout::side_by_side : layout, eye);
  return {size.width,    size.height,        options.full_screen, eye_buffers,
          options.setup, options.projectors, options.hide_control};
}

}  // namespace

Player::Player(const Show& show, RendererLoader::Make make, const PlayOptions& options)
    : loader_(make),
      renderer_(make(show)),
      show_(show),
      options_(options),
      screen_(screen_options(show, options)),
      pictures_([this](const PictureAnswer& answer) { screen_.show(answer); }, options.size_px),
      flight_(show),
      flying_(options.free_flight),
      times_shown_(options.times_shown),
      shown_stereo_(show.stereo),
      stereo_(shown_stereo_),
      field_of_view_deg_(show.view.field_of_view_deg) {
  backend_ = describe(renderer_->backend());
  if (by_eye() && screen_.window().buffers() == WindowBuffers::plain) {
    fmt::print(stderr, "ergodome: this driver has no buffers for each eye; the eyes are side by side\n");
    stereo_.layout = StereoLayout::side_by_side;
  }
}

Player::~Player() = default;

CameraPose Player::current_pose() const { return flying_ ? flight_.pose() : camera_pose(show(), show_time_s_); }

ShowMoment Player::moment() const {
  // A seek shows something soon, streamed or not, and a grid that takes longer is for the next picture.
  constexpr double patience_s = 0.02;
  return {flying_ ? std::nullopt : std::optional(show_time_s_), patience_s};
}

bool Player::moving() const {
  const bool playing = !flying_ && !paused_ && show().duration_s > 0.0;
  return changed_ || !held_keys_.empty() || playing;
}

void Player::run() {
  auto last = Clock::now();
  while (!screen_.closed() && !interrupted()) {
    for (const WindowEvent& event : screen_.events()) {
      handle(event);
    }
    const auto now = Clock::now();
    advance(std::chrono::duration<double>(now - last).count());
    last = now;
    update_picture();
    screen_.draw(by_eye());
    end_in_time();
  }
  if (options_.for_seconds > 0.0) {
    print_statistics();
  }
  if (!options_.screenshot.empty()) {
    screen_.save_screenshot(options_.screenshot, by_eye());
  }
}

void Player::update_picture() {
  take_renderer();
  if (!renderer_) {
    return;
  }
  const PictureRequest wish = {renderer_, current_pose(), mode_,   field_of_view_deg_,
                               0,         moment(),       stereo_, times_shown_};
  const bool is_moving = moving();
  note(pictures_.advance(wish, std::exchange(changed_, false), is_moving));
}

void Player::take_renderer() {
  auto loaded = loader_.take();
  if (!loaded) {
    return;
  }
  if (loaded->renderer) {
    renderer_ = std::move(loaded->renderer);
    changed_ = true;
  } else {
    say(loaded->problem);
    loader_.load(show_);
  }
}

void Player::note(PictureNews news) {
  if (news == PictureNews::none) {
    return;
  }
  if (news == PictureNews::hang) {
    renderer_.reset();
    loader_.load(show_);
  }
  if (!first_answer_) {
    first_answer_ = Clock::now();
  }
  say(pictures_.report().problem);
  screen_.set_text(panel_text());
  update_title();
}

void Player::say(const std::string& problem) {
  if (!problem.empty() && problem != said_problem_) {
    fmt::print(stderr, "ergodome: {}\n", problem);
  }
  said_problem_ = problem;
}

void Player::end_in_time() {
  if (options_.for_seconds > 0.0 && first_answer_ &&
      std::chrono::duration<double>(Clock::now() - *first_answer_).count() >= options_.for_seconds) {
    screen_.window().close();
  }
}

void Player::print_statistics() const {
  if (pictures_.report().pictures > 0) {
    fmt::print("{} pictures after the first in {:.1f} s\n", pictures_.report().pictures - 1, options_.for_seconds);
  }
  if (const auto streamed = renderer_ ? renderer_->stream_statistics() : std::nullopt) {
    ergodome::print_statistics(*streamed);
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
      screen_.window().framebuffer_size(width, height);
      const double radians_per_px = field_of_view_deg_ / 57.29577951308232 / std::max(width, 1);
      flight_.look(-event.dx * radians_per_px, event.dy * radians_per_px);
      break;
    }
    case WindowEvent::Kind::scroll:
      field_of_view_deg_ = std::clamp(field_of_view_deg_ * std::exp(-0.1 * event.dy), 0.01,
                                      show().view.projection == ViewProjection::pinhole ? 170.0 : 360.0);
      break;
  }
  changed_ = true;
}

void Player::press(int key) {
  const double duration_s = show().duration_s;
  switch (action_of(key)) {
    case KeyAction::quit:
      screen_.window().close();
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
      screen_.window().toggle_full_screen();
      break;
    case KeyAction::times:
      times_shown_ = !times_shown_;
      break;
    case KeyAction::next_view:
      mode_ = static_cast<ViewMode>((static_cast<int>(mode_) + 1) % 6);
      break;
    default:
      if (!screen_.has_projectors()) {  // what a dome's projectors show is one eye's
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
  const double duration_s = show().duration_s;
  if (!flying_ && !paused_ && duration_s > 0.0) {
    // The show loops; taking the rest keeps the time exact for as long as an exhibit runs.
    show_time_s_ = std::fmod(show_time_s_ + seconds, duration_s);
    changed_ = true;
  }
}

std::string Player::panel_text() const {
  if (!times_shown_) {
    return "";
  }
  const PictureReport& report = pictures_.report();
  std::string text =
      fmt::format("{:.1f} ms at {} px, {} lens, {}", report.frame_time_ms, report.size_px, report.lens, backend_);
  if (eye_count(stereo_) > 1) {
    text += "\n" + disparity_caption(stereo_, report.disparity);
  }
  return text;
}

void Player::update_title() {
  const PictureReport& report = pictures_.report();
  screen_.window().set_title(fmt::format(
      "Ergodome  {}  a {:.6g}  r {:.4g} M  {:.1f} s  {:.1f} ms at {} px  {} lens  {}{}", show().title, show().spin,
      current_pose().r, show_time_s_, report.frame_time_ms, report.size_px, report.lens, backend_,
      flying_   ? "  free flight"
      : paused_ ? "  paused"
                : ""));
}

}  // namespace ergodome
