#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/navigation/controls/help_layout.h"
#include "app/player/renderers/frame_source.h"
#include "render/present/presenter.h"
#include "render/present/projectors/projector_windows.h"
#include "render/present/text_panel.h"
#include "render/present/window.h"

namespace ergodome {

//! What the player's screen is made of.
struct ScreenOptions {
  int width_px = 1024;
  int height_px = 1024;
  bool full_screen = false;
  bool eye_buffers = false;                  //!< a buffer for each eye, where the driver has them
  std::optional<DomeSetup> setup;            //!< of a dome whose projectors show the pictures, too
  std::vector<ProjectorPicture> projectors;  //!< of the setup
  bool hide_control = false;                 //!< with a setup: the projectors' windows alone are to be seen
};

//! The windows that the player draws in: its own, and those of a dome's projectors.
class PlayerScreen {
 public:
  //! Throws Error where there is no display, or a projector's monitor is missing.
  explicit PlayerScreen(const ScreenOptions& options);

  //! Takes over a picture; it stays until the next one.
  void show(const PictureAnswer& answer);

  [[nodiscard]] Window& window() { return window_; }
  [[nodiscard]] bool has_projectors() const { return projectors_ != nullptr; }

  //! Waits some milliseconds for what people do to the windows.
  [[nodiscard]] std::vector<WindowEvent> events();
  [[nodiscard]] bool closed() const;

  //! Lines of text over the picture, at a place; none where it is empty. In the middle they are the help, a list whose cells tabs part:
  //! captions, other text and the mouse's cursor are not seen while it is.
  void set_text(PanelPlace place, const std::string& text);

  //! Factor on the light of pictures, 0 to 1; text keeps its own.
  void set_light(double light) { presenter_.set_light(static_cast<float>(light)); }

  //! Draws the last picture in all windows, its eyes as they came with it.
  void draw();

  //! Writes what the windows show: FILE, and FILE_PROJECTOR for each projector.
  void save_screenshot(const std::string& file);

 private:
  void draw_window(int width, int height);
  //! Parts of a window of a size that text stands in: all of it, or those of the eyes.
  [[nodiscard]] std::vector<PanelArea> eye_areas(int width, int height) const;
  //! Of one of these, in pixels of text.
  [[nodiscard]] TextSize room_for_text();
  [[nodiscard]] bool help_shown() const;
  const FittedText& fitted_help(const std::string& list, const TextSize& window, int usual_px);

  std::optional<DomeSetup> setup_;
  Window window_;
  Presenter presenter_;
  EyesInWindow eyes_ = EyesInWindow::as_one;  //!< of the last picture
  EyeGrid grid_;                              //!< of the last picture's eyes
  LaidCaptions captions_;
  double legend_part_ = 0.0;  //!< of the last picture's height, taken by its legend
  struct Text {
    TextPanel panel;
    std::string words;
  };
  std::map<PanelPlace, Text> texts_;
  struct Help {
    std::string list;
    TextSize window;
    FittedText fitted;
  };
  Help help_;                                     //!< as it was fitted last
  std::unique_ptr<ProjectorWindows> projectors_;  //!< where there is a setup
};

}  // namespace ergodome
