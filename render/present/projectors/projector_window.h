#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "calibration/dome/dome_setup.h"
#include "render/present/desktop.h"
#include "render/present/window.h"

// The window of one projector.

namespace ergodome {

//! Whether swapping buffers waits for the display's next refresh (`in_step`) or not.
enum class SwapTiming { in_step, at_once };

//! The window of one projector: a whole monitor, or a frameless window of the projector's
//! resolution. Its context shares textures and buffers with the control window, which must outlive
//! it.
class ProjectorWindow {
 public:
  //! Throws Error if the window cannot be opened. The monitor must be connected (require_outputs).
  ProjectorWindow(const Window& control, const ProjectorSetup& projector, SwapTiming timing);
  ~ProjectorWindow();
  ProjectorWindow(const ProjectorWindow&) = delete;
  ProjectorWindow& operator=(const ProjectorWindow&) = delete;

  //! Makes the window's OpenGL context current.
  void make_current();
  void swap();
  //! Calls join_swap_group(); the window's context must be current.
  [[nodiscard]] std::string join_swap_group(bool joined);
  [[nodiscard]] bool closed() const;

  //! Returns the input events of this window since the last call. Window::events() of any window
  //! collects them.
  std::vector<WindowEvent> events();

  //! Returns the size of the framebuffer in pixels.
  void framebuffer_size(int& width, int& height) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

//! Returns the connected monitors, in GLFW's order. Requires an open window.
std::vector<DesktopMonitor> connected_monitors();

//! Returns the number of the first monitor without a full-screen projector of the setup; -1 if
//! there is none.
int free_monitor(const DomeSetup& setup);

}  // namespace ergodome
