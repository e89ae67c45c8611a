#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "calibration/dome/dome_setup.h"
#include "render/present/desktop.h"
#include "render/present/window.h"

namespace ergodome {

//! How a window shows what was drawn: with the display's next picture, or at once.
enum class SwapTiming { in_step, at_once };

//! The window of one projector: a whole monitor, or a window of the projector's resolution without a frame. Its context shares textures and
//! buffers with the control window's, which must outlive it.
class ProjectorWindow {
 public:
  //! Throws Error where it cannot be opened. The monitor must be there (require_outputs).
  ProjectorWindow(const Window& control, const ProjectorSetup& projector, SwapTiming timing);
  ~ProjectorWindow();
  ProjectorWindow(const ProjectorWindow&) = delete;
  ProjectorWindow& operator=(const ProjectorWindow&) = delete;

  //! Makes its context the current one.
  void make_current();
  void swap();
  [[nodiscard]] bool closed() const;

  //! What was done to it since the last call; Window::events lets it happen.
  std::vector<WindowEvent> events();

  //! Size of the framebuffer in pixels.
  void framebuffer_size(int& width, int& height) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

//! The monitors that there are, in their order. Needs a window to have been opened.
std::vector<DesktopMonitor> connected_monitors();

//! The number of the first monitor on which no projector of a setup is shown full screen; -1 where there is none.
int free_monitor(const DomeSetup& setup);

}  // namespace ergodome
