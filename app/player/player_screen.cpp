#include "app/player/player_screen.h"

#include <algorithm>
#include <sstream>

#include "app/setup_show.h"
#include "render/output/image_writer.h"

namespace ergodome {

namespace {

//! Largest window that opens by itself: a screen's, and beside projectors a part of it.
constexpr int widest_px = 1600;
constexpr int highest_px = 1000;
constexpr int beside_projectors_px = 700;

//! The largest letters of one width with which a text fits into a window.
int fitting_px(const std::string& text, int width, int height) {
  constexpr double letter_width = 0.61;
  constexpr double line_height = 1.5;
  std::stringstream lines(text);
  std::size_t longest = 1;
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    const auto letters = std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; });
    longest = std::max(longest, static_cast<std::size_t>(letters));
  }
  const double by_width = width / (letter_width * static_cast<double>(longest) + 1.0);
  const double by_height = height / (line_height * count + 1.0);
  return std::max(static_cast<int>(std::min(by_width, by_height)), 6);
}

}  // namespace

PlayerScreen::PlayerScreen(const ScreenOptions& options)
    : setup_(options.setup),
      window_(std::min(options.width_px, options.setup ? beside_projectors_px : widest_px),
              std::min(options.height_px, options.setup ? beside_projectors_px : highest_px), "Ergodome",
              options.full_screen, options.eye_buffers ? WindowBuffers::stereo : WindowBuffers::plain) {
  if (setup_) {
    projectors_ = std::make_unique<ProjectorWindows>(window_, *setup_, options.projectors, options.hide_control);
  }
}

void PlayerScreen::show(const PictureAnswer& answer) {
  if (answer.on_device) {
    presenter_.upload_from_device(*answer.on_device);
  } else if (answer.right_eye) {
    presenter_.upload_eyes(answer.picture, *answer.right_eye, answer.eyes_above);
  } else {
    presenter_.upload(answer.picture);
  }
}

std::vector<WindowEvent> PlayerScreen::events() {
  constexpr double patience_s = 0.004;
  std::vector<WindowEvent> all = window_.events(patience_s);
  if (projectors_) {
    const std::vector<WindowEvent> others = projectors_->events();
    all.insert(all.end(), others.begin(), others.end());
  }
  return all;
}

bool PlayerScreen::closed() const { return window_.closed() || (projectors_ && projectors_->closed()); }

void PlayerScreen::set_text(PanelPlace place, const std::string& text) {
  Text& panel = texts_[place];
  panel.words = text;
  if (!text.empty()) {
    int width = 0;
    int height = 0;
    window_.framebuffer_size(width, height);
    // Help, in the middle, has columns, and is as large as the window lets it.
    const bool help = place == PanelPlace::middle;
    const int usual_px = std::clamp(std::min(width, height) / 50, 11, 36);
    panel.panel.set(text, help ? std::min(usual_px, fitting_px(text, width, height)) : usual_px,
                    help ? TextFace::monospaced : TextFace::proportional);
  }
}

void PlayerScreen::draw_window(int width, int height, bool by_eye) {
  const auto draw_part = [&](WindowEye eye, PicturePart part) {
    window_.draw_into(eye);
    presenter_.draw(width, height, part);
    for (auto& [place, text] : texts_) {
      if (!text.words.empty()) {
        text.panel.draw(width, height, place);
      }
    }
  };
  if (by_eye) {
    draw_part(WindowEye::left, PicturePart::left_half);
    draw_part(WindowEye::right, PicturePart::right_half);
  } else {
    draw_part(WindowEye::both, PicturePart::whole);
  }
}

void PlayerScreen::draw(bool by_eye) {
  if (projectors_) {
    projectors_->show(presenter_.shown());
    if (!projectors_->control_shown()) {
      return;
    }
  }
  int width = 0;
  int height = 0;
  window_.framebuffer_size(width, height);
  draw_window(width, height, by_eye);
  window_.swap();
}

void PlayerScreen::save_screenshot(const std::string& file, bool by_eye) {
  if (projectors_) {
    projectors_->save_screenshots(file, plain_names(*setup_));
  }
  int width = 0;
  int height = 0;
  window_.framebuffer_size(width, height);
  if (width > 0 && height > 0) {
    draw_window(width, height, by_eye);
    write_png(file, Presenter::read_back(width, height), width, height);
  }
}

}  // namespace ergodome
