#include "app/player/player_screen.h"

#include <algorithm>

#include "app/cli/setup_show.h"
#include "render/output/color_bar.h"
#include "render/output/image_writer.h"
#include "render/output/text_image.h"

namespace ergodome {

namespace {

//! Maximum initial size of the window [px]: alone, and in addition to projectors.
constexpr int widest_px = 1600;
constexpr int highest_px = 1000;
constexpr int beside_projectors_px = 700;

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
  eyes_ = answer.eyes;
  // A heat map has its legend at the bottom.
  legend_part_ = answer.picture.heat_range ? color_bar_part(answer.picture.width, answer.picture.height) : 0.0;
  grid_ = answer.eye_grid;
  captions_ = answer.captions;
  if (answer.on_device) {
    presenter_.upload_from_device(*answer.on_device);
  } else if (answer.right_eye) {
    presenter_.upload_eyes(answer.picture, *answer.right_eye, answer.eyes_above);
  } else {
    presenter_.upload(answer.picture);
  }
  if (projectors_) {
    projectors_->take(answer.on_device ? &*answer.on_device : nullptr);
    projectors_->lay_over(captions_);
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

std::vector<PanelArea> PlayerScreen::eye_areas(int width, int height) const {
  const PictureArea whole = presenter_.area(width, height);
  if ((grid_.columns == 1 && grid_.rows == 1) || eyes_ != EyesInWindow::as_one || whole.width == 0) {
    return {{0, 0, width, height}};
  }
  const int eye_width = whole.width / grid_.columns;
  const int eye_height = whole.height / grid_.rows;
  const PanelArea first = {whole.left, whole.bottom, eye_width, eye_height, grid_.across, grid_.along};
  PanelArea second = first;
  second.left += (grid_.columns - 1) * eye_width;
  second.bottom += (grid_.rows - 1) * eye_height;
  return {first, second};
}

TextSize PlayerScreen::room_for_text() {
  int width = 0;
  int height = 0;
  window_.framebuffer_size(width, height);
  const PanelArea area = eye_areas(width, height).front();
  return {static_cast<int>(area.width / area.across), static_cast<int>(area.height / area.along)};
}

void PlayerScreen::set_text(PanelPlace place, const std::string& text) {
  Text& panel = texts_[place];
  panel.words = text;
  if (place == PanelPlace::middle) {
    window_.show_cursor(text.empty());
  }
  if (!text.empty()) {
    const TextSize room = room_for_text();
    const int usual_px = std::clamp(std::min(room.width_px, room.height_px) / 50, 11, 36);
    if (place == PanelPlace::middle) {
      // Help is a list in columns, as large as the window allows.
      const FittedText& list = fitted_help(text, room, usual_px);
      panel.panel.set(list.text, list.letter_px, TextFace::monospaced);
    } else {
      panel.panel.set(text, usual_px, TextFace::proportional, room.width_px, PanelGround::none);
    }
  }
}

bool PlayerScreen::help_shown() const {
  const auto help = texts_.find(PanelPlace::middle);
  return help != texts_.end() && !help->second.words.empty();
}

const FittedText& PlayerScreen::fitted_help(const std::string& list, const TextSize& window, int usual_px) {
  if (list != help_.list || window != help_.window) {
    const MeasureText measure = [](const std::string& text, int letter_px) {
      const TextLinesSize size = text_lines_size(text, letter_px, TextFace::monospaced);
      return TextSize{size.width, size.height};
    };
    help_ = {list, window, fit_list(list, window, usual_px, measure)};
  }
  return help_.fitted;
}

void PlayerScreen::draw_window(int width, int height) {
  const bool help = help_shown();
  // Hides the captions while help is shown.
  presenter_.lay_over(help ? LaidCaptions() : captions_, grid_);
  const auto draw_part = [&](WindowEye eye, PicturePart part) {
    window_.draw_into(eye);
    presenter_.draw(width, height, part);
    for (const PanelArea& area : eye_areas(width, height)) {
      for (auto& [place, text] : texts_) {
        if (!text.words.empty() && (!help || place == PanelPlace::middle)) {
          text.panel.draw(area, place, legend_part_);
        }
      }
    }
  };
  if (eyes_ == EyesInWindow::in_buffers) {
    draw_part(WindowEye::left, PicturePart::left_half);
    draw_part(WindowEye::right, PicturePart::right_half);
  } else {
    draw_part(WindowEye::both, eyes_ == EyesInWindow::in_rows ? PicturePart::halves_by_rows : PicturePart::whole);
  }
}

void PlayerScreen::draw() {
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

void PlayerScreen::save_screenshot(const std::string& file) {
  if (projectors_) {
    projectors_->save_screenshots(file, plain_names(*setup_));
  }
  int width = 0;
  int height = 0;
  window_.framebuffer_size(width, height);
  if (width > 0 && height > 0) {
    draw_window(width, height);
    write_png(file, Presenter::read_back(width, height), width, height);
  }
}

}  // namespace ergodome
