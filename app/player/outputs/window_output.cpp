#include "app/player/outputs/window_output.h"

#include <algorithm>

#include "render/opengl/gl_program.h"
#include "render/opengl/headless_context.h"
#include "render/output/color_bar.h"
#include "render/output/image_writer.h"
#include "render/output/text_image.h"

namespace ergodome {

WindowOutput::WindowOutput(const WindowOptions& options)
    : window_(std::min(options.size.width, options.largest.width),
              std::min(options.size.height, options.largest.height), "Ergodome", options.full_screen,
              options.eye_buffers ? WindowBuffers::stereo : WindowBuffers::plain) {
  if (options.full_screen) {
    window_.hide_cursor();
  }
  if (draws_in_software()) {
    presenter_.encode_before_upload();
  }
}

OutputWish WindowOutput::wish() {
  if (const ImageSize now = size(); now.width > 0 && now.height > 0) {
    last_size_ = now;
  }
  OutputWish wish;
  wish.window = last_size_;
  return wish;
}

void WindowOutput::take(OutputFrame& frame) {
  eyes_ = frame.eyes;
  // A heat map has its legend at the bottom.
  legend_part_ = frame.picture.heat_range ? color_bar_part(frame.picture.width, frame.picture.height) : 0.0;
  grid_ = frame.eye_grid;
  captions_ = frame.captions;
  if (frame.on_device) {
    presenter_.upload_from_device(*frame.on_device);
  } else if (frame.right_eye) {
    presenter_.upload_eyes(frame.picture, *frame.right_eye, frame.eyes_above);
  } else {
    presenter_.upload(frame.picture);
  }
}

std::vector<WindowEvent> WindowOutput::events() {
  constexpr double patience_s = 0.004;
  return window_.events(patience_s);
}

ImageSize WindowOutput::size() const {
  ImageSize size = {0, 0};
  window_.framebuffer_size(size.width, size.height);
  return size;
}

std::vector<PanelArea> WindowOutput::eye_areas(const ImageSize& size) const {
  const PictureArea whole = presenter_.area(size.width, size.height);
  if ((grid_.columns == 1 && grid_.rows == 1) || eyes_ != EyesInWindow::as_one || whole.width == 0) {
    return {{0, 0, size.width, size.height}};
  }
  const int eye_width = whole.width / grid_.columns;
  const int eye_height = whole.height / grid_.rows;
  const PanelArea first = {whole.left, whole.bottom, eye_width, eye_height, grid_.across, grid_.along};
  PanelArea second = first;
  second.left += (grid_.columns - 1) * eye_width;
  second.bottom += (grid_.rows - 1) * eye_height;
  return {first, second};
}

TextSize WindowOutput::room_for_text() const {
  const PanelArea area = eye_areas(size()).front();
  return {static_cast<int>(area.width / area.across), static_cast<int>(area.height / area.along)};
}

void WindowOutput::set_text(PanelPosition position, const std::string& text) {
  Text& panel = texts_[position];
  panel.words = text;
  if (position == PanelPosition::middle) {
    window_.show_cursor(text.empty());
  }
  if (!text.empty()) {
    const TextSize room = room_for_text();
    const int usual_px = std::clamp(std::min(room.width_px, room.height_px) / 50, 11, 36);
    if (position == PanelPosition::middle) {
      // Help is a list in columns, as large as the window allows.
      const FittedText& list = fitted_help(text, room, usual_px);
      panel.panel.set(list.text, list.letter_px, TextFace::monospaced);
    } else {
      panel.panel.set(text, usual_px, TextFace::proportional, room.width_px, PanelGround::none);
    }
  }
}

bool WindowOutput::help_shown() const {
  const auto help = texts_.find(PanelPosition::middle);
  return help != texts_.end() && !help->second.words.empty();
}

const FittedText& WindowOutput::fitted_help(const std::string& list, const TextSize& window, int usual_px) {
  if (list != help_.list || window != help_.window) {
    const MeasureText measure = [](const std::string& text, int letter_px) {
      const TextLinesSize size = text_lines_size(text, letter_px, TextFace::monospaced);
      return TextSize{size.width, size.height};
    };
    help_ = {list, window, fit_list(list, window, usual_px, measure)};
  }
  return help_.fitted;
}

void WindowOutput::draw_window(const ImageSize& size) {
  const bool help = help_shown();
  // Hides the captions while help is shown.
  presenter_.lay_over(help ? LaidCaptions() : captions_, grid_);
  const auto draw_part = [&](WindowEye eye, PicturePart part) {
    window_.draw_into(eye);
    presenter_.draw(size.width, size.height, part);
    for (const PanelArea& area : eye_areas(size)) {
      for (auto& [position, text] : texts_) {
        if (!text.words.empty() && (!help || position == PanelPosition::middle)) {
          text.panel.draw(area, position, legend_part_);
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

void WindowOutput::show() {
  draw_window(size());
  window_.swap();
}

void WindowOutput::save_screenshot(const std::string& file) {
  if (const ImageSize now = size(); now.width > 0 && now.height > 0) {
    draw_window(now);
    write_png(file, read_framebuffer(now.width, now.height), now.width, now.height);
  }
}

}  // namespace ergodome
