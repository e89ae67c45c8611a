#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/commands/calibrate/calibration_keys.h"
#include "app/commands/calibrate/live_calibration.h"
#include "app/player/cluster_gate.h"
#include "calibration/projectors/dome_pictures.h"
#include "render/present/presenter.h"
#include "render/present/projectors/projector_windows.h"
#include "render/present/text_panel.h"
#include "render/present/window.h"

namespace ergodome {

//! Options of a live calibration.
struct LiveOptions {
  std::string setup;  //!< the setup file, which is also the file that is saved
  //! Width of the domemaster of test patterns; 0: sufficient for the projectors.
  int master_px = 0;
  bool hide_control = false;
  bool cluster = false;      //!< nodes show their projectors' part
  double for_seconds = 0.0;  //!< closes the windows after this time; 0: when a user closes them
  //! Last contents of the windows, as FILE_PROJECTOR.png for FILE.png; empty: none.
  std::string screenshot;
};

//! Shows test patterns on the projectors of a dome and adjusts its setup by keys.
class CalibrationWindow {
 public:
  //! Throws Error if the setup or one of its files is wrong, or if the display or a monitor is
  //! missing.
  explicit CalibrationWindow(const LiveOptions& options);

  //! Runs until a window is closed, `for_seconds` have passed, or the program is interrupted. Then
  //! writes the screenshots, if requested, and prints a note if changes were not saved.
  void run();

 private:
  using Clock = std::chrono::steady_clock;

  void handle(const WindowEvent& event);
  void repeat_held_key();
  void act(CalibrationAction action);
  void save();
  //! Prints why nothing can be saved, unless it is the message printed last.
  void report_refusal(const std::string& problem);
  //! Shows the changes that keys have made since the last call.
  void renew();
  //! Replaces one of the coarse masks, with which the window started, by one of full resolution,
  //! and shows it. Returns false if no coarse mask is left.
  bool refine();
  void renew_master();
  bool renew_projectors();
  void renew_text();
  void draw();
  //! Sends the pattern and the changes to the nodes.
  void publish();
  void advance_cluster();
  //! Returns whether an action would change what was saved, although the nodes do not have it yet.
  [[nodiscard]] bool needs_nodes(CalibrationAction action) const;
  //! Returns the index of a projector among those of this computer, if it is one.
  [[nodiscard]] std::optional<std::size_t> window_of(std::size_t projector) const;
  [[nodiscard]] std::vector<ProjectorPicture> own_pictures() const;
  [[nodiscard]] std::vector<std::string> texts() const;
  [[nodiscard]] std::string pattern_name() const;

  LiveOptions options_;
  int drawn_px_ = 0;  //!< width of the domemaster that the next pattern is drawn at
  LiveCalibration state_;
  DomePictures pictures_;
  std::vector<std::size_t> own_;  //!< indices of this computer's projectors
  std::optional<ClusterHost> host_;
  bool saved_ = false;
  Window window_;
  Presenter presenter_;
  TextPanel keys_panel_;
  ProjectorWindows projectors_;
  //! Result of the last save, or why a change cannot be shown.
  std::string message_;
  std::string reported_refusal_;        //!< reason last printed for a failed save
  Renewal renewal_ = Renewal::nothing;  //!< updates requested by keys since the last drawing
  KeyRepeat keys_;
};

}  // namespace ergodome
