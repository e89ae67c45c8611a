#include "render/present/projectors/projector_window.h"

#include <GLFW/glfw3.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <span>

#include "content/files/console.h"
#include "kernels/core/error.h"
#include "render/present/projectors/swap_group.h"

namespace ergodome {

struct ProjectorWindow::State {
  GLFWwindow* window = nullptr;
  std::vector<WindowEvent> events;
};

namespace {

std::span<GLFWmonitor*> monitors() {
  int count = 0;
  GLFWmonitor** const first = glfwGetMonitors(&count);
  return {first, static_cast<std::size_t>(count)};
}

//! Opens a full-screen window that keeps the monitor's resolution.
GLFWwindow* whole_screen(const ProjectorSetup& projector, const std::string& title, GLFWwindow* shared) {
  GLFWmonitor* const monitor = monitors()[static_cast<std::size_t>(*projector.output.monitor)];
  const GLFWvidmode* const mode = glfwGetVideoMode(monitor);
  if (mode->width != projector.width_px || mode->height != projector.height_px) {
    print_note("projector {} has {} x {} pixels, but its monitor has {} x {}; the picture is scaled", projector.name,
               projector.width_px, projector.height_px, mode->width, mode->height);
  }
  glfwWindowHint(GLFW_REFRESH_RATE, mode->refreshRate);
  // Prevents a click outside the window from minimizing the picture on the dome.
  glfwWindowHint(GLFW_AUTO_ICONIFY, GLFW_FALSE);
  return glfwCreateWindow(mode->width, mode->height, title.c_str(), monitor, shared);
}

GLFWwindow* frameless(const ProjectorSetup& projector, const std::string& title, GLFWwindow* shared) {
  glfwWindowHint(GLFW_DECORATED, GLFW_FALSE);
  glfwWindowHint(GLFW_RESIZABLE, GLFW_FALSE);
  glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
  GLFWwindow* const window = glfwCreateWindow(projector.width_px, projector.height_px, title.c_str(), nullptr, shared);
  if (window != nullptr) {
    // Set the position before the window is visible, so that window managers do not choose one.
    glfwSetWindowPos(window, projector.output.window_x_px, projector.output.window_y_px);
    glfwShowWindow(window);
  }
  return window;
}

GLFWwindow* opened(const ProjectorSetup& projector, GLFWwindow* shared) {
  const std::string title = "Ergodome " + projector.name;
  glfwDefaultWindowHints();
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  GLFWwindow* const window =
      projector.output.monitor ? whole_screen(projector, title, shared) : frameless(projector, title, shared);
  glfwDefaultWindowHints();
  return window;
}

}  // namespace

ProjectorWindow::ProjectorWindow(const Window& control, const ProjectorSetup& projector, SwapTiming timing)
    : state_(std::make_unique<State>()) {
  state_->window = opened(projector, static_cast<GLFWwindow*>(control.handle()));
  if (state_->window == nullptr) {
    const char* reason = nullptr;
    glfwGetError(&reason);
    throw Error(location_of(projector),
                fmt::format("its window cannot be opened: {}", reason != nullptr ? reason : "no reason given"),
                "check its monitor or window_px, and that the driver has OpenGL 4.5");
  }
  make_current();
  glfwSwapInterval(timing == SwapTiming::in_step ? 1 : 0);
  glfwSetInputMode(state_->window, GLFW_CURSOR, GLFW_CURSOR_HIDDEN);
  glfwSetWindowUserPointer(state_->window, &state_->events);
  glfwSetKeyCallback(state_->window, [](GLFWwindow* window, int key, int, int action, int) {
    if (action != GLFW_REPEAT) {
      static_cast<std::vector<WindowEvent>*>(glfwGetWindowUserPointer(window))
          ->push_back({action == GLFW_PRESS ? WindowEvent::Kind::key_down : WindowEvent::Kind::key_up, key, 0.0, 0.0});
    }
  });
}

ProjectorWindow::~ProjectorWindow() { glfwDestroyWindow(state_->window); }

void ProjectorWindow::make_current() { glfwMakeContextCurrent(state_->window); }

void ProjectorWindow::swap() { glfwSwapBuffers(state_->window); }

std::string ProjectorWindow::join_swap_group(bool joined) { return ergodome::join_swap_group(state_->window, joined); }

bool ProjectorWindow::closed() const { return glfwWindowShouldClose(state_->window) == GLFW_TRUE; }

std::vector<WindowEvent> ProjectorWindow::events() {
  std::vector<WindowEvent> since;
  since.swap(state_->events);
  return since;
}

void ProjectorWindow::framebuffer_size(int& width, int& height) const {
  glfwGetFramebufferSize(state_->window, &width, &height);
}

std::vector<DesktopMonitor> connected_monitors() {
  std::vector<DesktopMonitor> connected;
  for (GLFWmonitor* const monitor : monitors()) {
    DesktopMonitor made{glfwGetMonitorName(monitor), {}, {}};
    glfwGetMonitorPos(monitor, &made.screen.x_px, &made.screen.y_px);
    // A monitor that was just unplugged has no mode. It stays in the list, with an empty screen, so
    // that the numbers of the other monitors do not change.
    if (const GLFWvidmode* const mode = glfwGetVideoMode(monitor)) {
      made.screen.width_px = mode->width;
      made.screen.height_px = mode->height;
    }
    DesktopRectangle& area = made.work_area;
    glfwGetMonitorWorkarea(monitor, &area.x_px, &area.y_px, &area.width_px, &area.height_px);
    connected.push_back(made);
  }
  return connected;
}

int free_monitor(const DomeSetup& setup) {
  for (int monitor = 0; monitor < static_cast<int>(monitors().size()); ++monitor) {
    if (std::ranges::none_of(setup.projectors, [&](const ProjectorSetup& p) { return p.output.monitor == monitor; })) {
      return monitor;
    }
  }
  return -1;
}

}  // namespace ergodome
