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

//! Options of the player's screen.
struct ScreenOptions {
  int width_px = 1024;
  int height_px = 1024;
  bool full_screen = false;
  bool eye_buffers = false;                  //!< a buffer for each eye, if the driver supports it
  std::optional<DomeSetup> setup;            //!< a dome whose projectors also show the picture
  std::vector<ProjectorPicture> projectors;  //!< projectors of the setup
  bool hide_control = false;                 //!< with a setup: shows only the projectors' windows
};

//! The windows that the player draws in: its main window and those of a dome's projectors.
class PlayerScreen {
 public:
  //! Throws Error if there is no display or if a projector's monitor is missing.
  explicit PlayerScreen(const ScreenOptions& options);

  //! Uploads a picture, which is shown until the next one.
  void show(const PictureAnswer& answer);

  [[nodiscard]] Window& window() { return window_; }
  [[nodiscard]] bool has_projectors() const { return projectors_ != nullptr; }

  //! Waits some milliseconds for events of the windows.
  [[nodiscard]] std::vector<WindowEvent> events();
  [[nodiscard]] bool closed() const;

  //! Sets the text over the picture at a location; empty: none. PanelPlace::middle is for help, a
  //! list with cells separated by tabs; while it is shown, captions, other text and the mouse
  //! cursor are hidden.
  void set_text(PanelPlace place, const std::string& text);

  //! Sets the factor on the light of pictures, 0 to 1. It does not affect text.
  void set_light(double light) { presenter_.set_light(static_cast<float>(light)); }

  //! Draws the last picture in all windows, with the stereo layout that it was rendered for.
  void draw();

  //! Writes the contents of the windows: FILE, and FILE_PROJECTOR for each projector.
  void save_screenshot(const std::string& file);

 private:
  void draw_window(int width, int height);
  //! Returns the areas of a window that text is drawn in: the whole window, or one area per eye.
  [[nodiscard]] std::vector<PanelArea> eye_areas(int width, int height) const;
  //! Returns the size of such an area in pixels of text.
  [[nodiscard]] TextSize room_for_text();
  [[nodiscard]] bool help_shown() const;
  const FittedText& fitted_help(const std::string& list, const TextSize& window, int usual_px);

  std::optional<DomeSetup> setup_;
  Window window_;
  Presenter presenter_;
  EyesInWindow eyes_ = EyesInWindow::as_one;  //!< of the last picture
  EyeGrid grid_;                              //!< of the last picture's eyes
  LaidCaptions captions_;
  double legend_part_ = 0.0;  //!< fraction of the last picture's height that its legend takes
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
  Help help_;                                     //!< help as last fitted to the window
  std::unique_ptr<ProjectorWindows> projectors_;  //!< null without a setup
};

}  // namespace ergodome
