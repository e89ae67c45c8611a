#pragma once

#include <string>
#include <vector>

#include "app/player/outputs/window_output.h"
#include "render/present/projectors/projector_windows.h"

namespace ergodome {

//! The projectors of a dome.
struct ProjectorOptions {
  DomeSetup setup;
  std::vector<ProjectorPicture> pictures;  //!< picture of each projector of the setup
  int master_px = 0;                       //!< width of the domemaster: enough_master_px() of the pictures
  bool hide_control = false;               //!< shows only the projectors' windows
};

//! Removes the projectors that are not connected to a node; empty: to the master. Their pictures
//! must exist already, because masks depend on the projectors of all nodes.
void keep_projectors_of(ProjectorOptions& projectors, const std::string& node);

//! A window for each projector of a dome, and the player's window as a control window.
class DomeOutput : public WindowOutput {
 public:
  //! Throws Error if there is no display or if a projector's monitor is missing.
  DomeOutput(const WindowOptions& window, const ProjectorOptions& projectors);

  [[nodiscard]] OutputWish wish() override;
  void take(OutputFrame& frame) override;
  void show() override;
  [[nodiscard]] bool closed() const override { return WindowOutput::closed() || projectors_.closed(); }
  [[nodiscard]] bool is_dome() const override { return true; }
  [[nodiscard]] std::vector<WindowEvent> events() override;
  void set_projectors(const std::vector<ProjectorPicture>& pictures) override;
  void set_rasters(const std::vector<Picture>& rasters) override;
  void set_projector_texts(const std::vector<std::string>& texts) override;
  [[nodiscard]] std::string join_swap_group(bool joined) override { return projectors_.join_swap_group(joined); }
  //! Writes a screenshot of the control window to `file`, and FILE_PROJECTOR for each projector.
  void save_screenshot(const std::string& file) override;

 private:
  std::vector<std::string> names_;  //!< names of the projectors, for file names
  int master_px_;
  ProjectorWindows projectors_;
};

}  // namespace ergodome
