#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/navigation/controls/help_layout.h"
#include "render/present/output.h"
#include "render/present/presenter.h"

namespace ergodome {

//! Options of the player's window.
struct WindowOptions {
  ImageSize size = {1024, 1024};     //!< size of the picture [px]
  ImageSize largest = {1600, 1000};  //!< limit of the window's initial size [px]
  bool full_screen = false;          //!< fills a monitor and hides the mouse cursor
  bool eye_buffers = false;          //!< a buffer for each eye, if the driver supports it
};

//! The player's window, with captions and text over the picture.
class WindowOutput : public DisplayOutput {
 public:
  //! Throws Error if there is no display.
  explicit WindowOutput(const WindowOptions& options);

  [[nodiscard]] OutputWish wish() override;
  void take(OutputFrame& frame) override;
  void set_light(double light) override { presenter_.set_light(static_cast<float>(light)); }
  void show() override;
  [[nodiscard]] bool closed() const override { return window_.closed(); }
  void close() override { window_.close(); }
  [[nodiscard]] bool has_eye_buffers() const override { return window_.buffers() == WindowBuffers::stereo; }
  [[nodiscard]] std::vector<WindowEvent> events() override;
  [[nodiscard]] ImageSize size() const override;
  void toggle_full_screen() override { window_.toggle_full_screen(); }
  void set_title(const std::string& title) override { window_.set_title(title); }
  //! Also hides the mouse cursor while help is shown.
  void set_text(PanelPosition position, const std::string& text) override;
  void save_screenshot(const std::string& file) override;

 protected:
  [[nodiscard]] Window& window() { return window_; }
  [[nodiscard]] PresentedPicture shown() const { return presenter_.shown(); }

 private:
  void draw_window(const ImageSize& size);
  //! Returns the areas of a window that text is drawn in: the whole window, or one area per eye.
  [[nodiscard]] std::vector<PanelArea> eye_areas(const ImageSize& size) const;
  //! Returns the size of one of the areas of eye_areas(), in pixels of text.
  [[nodiscard]] TextSize room_for_text() const;
  [[nodiscard]] bool help_shown() const;
  const FittedText& fitted_help(const std::string& list, const TextSize& window, int usual_px);

  Window window_;
  Presenter presenter_;
  //! Size of the window; if it is minimized, its size before; absent at first.
  std::optional<ImageSize> last_size_;
  EyesInWindow eyes_ = EyesInWindow::as_one;  //!< arrangement of the eyes in the last picture
  EyeGrid grid_;                              //!< arrangement of the last picture's eyes in a grid
  LaidCaptions captions_;
  double legend_part_ = 0.0;  //!< fraction of the last picture's height that its legend takes
  struct Text {
    TextPanel panel;
    std::string words;
  };
  std::map<PanelPosition, Text> texts_;
  struct Help {
    std::string list;
    TextSize window;
    FittedText fitted;
  };
  Help help_;  //!< help as last fitted to the window
};

}  // namespace ergodome
