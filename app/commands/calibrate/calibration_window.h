#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/commands/calibrate/key_repeat.h"
#include "app/commands/calibrate/live_calibration.h"
#include "calibration/dome/dome_pictures.h"
#include "render/present/presenter.h"
#include "render/present/projectors/projector_windows.h"
#include "render/present/text_panel.h"
#include "render/present/window.h"

namespace ergodome {

struct LiveOptions {
  std::string setup;  //!< file of the setup, which is also saved to
  int master_px = 0;  //!< width of the test patterns' master; 0: enough for the projectors
  bool hide_control = false;
  double for_seconds = 0.0;  //!< ends by itself; 0: when it is closed
  std::string screenshot;    //!< what the windows showed last, as FILE_PROJECTOR.png for FILE.png; empty: none
};

//! Shows test patterns on the projectors of a dome, and lets keys adjust its setup.
class CalibrationWindow {
 public:
  //! Throws Error for what is wrong with the setup or its files, where there is no display, or a monitor is missing.
  explicit CalibrationWindow(const LiveOptions& options);

  //! Until it is closed.
  void run();

 private:
  using Clock = std::chrono::steady_clock;

  void handle(const WindowEvent& event);
  void repeat_held_key();
  void act(CalibrationAction action);
  void save();
  //! Says on the terminal why nothing can be saved, unless it said so last.
  void tell_refusal(const std::string& problem);
  //! Shows what keys have changed since the last time.
  void renew();
  //! Replaces one of the coarse masks that the window started with. Returns false once there is none.
  bool refine();
  void renew_master();
  bool renew_projectors();
  void renew_text();
  void draw();
  [[nodiscard]] std::string pattern_name() const;

  LiveOptions options_;
  int drawn_px_ = 0;  //!< domemaster width for the next pattern that is drawn
  LiveCalibration state_;
  DomePictures pictures_;
  Window window_;
  Presenter presenter_;
  TextPanel keys_panel_;
  ProjectorWindows projectors_;
  std::string message_;                 //!< of the last saving, or why a change cannot be shown
  std::string told_refusal_;            //!< why nothing could be saved, as the terminal says it last
  Renewal renewal_ = Renewal::nothing;  //!< what keys since the last drawing ask for
  KeyRepeat keys_;
};

}  // namespace ergodome
