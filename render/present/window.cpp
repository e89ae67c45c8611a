#include "render/present/window.h"

#include <GLFW/glfw3.h>
#include <epoxy/gl.h>

#include <optional>
#include <utility>

#include "kernels/core/error.h"

namespace ergodome {

struct Window::State {
  GLFWwindow* window = nullptr;
  std::vector<WindowEvent> events;
  WindowBuffers buffers = WindowBuffers::plain;
  bool without_cursor = false;
  std::optional<std::pair<double, double>> pointer;  //!< last position of the pointer
  //! Position and size of the window to restore when full screen ends.
  int windowed[4] = {0, 0, 1024, 1024};
};

namespace {

std::vector<WindowEvent>& events_of(GLFWwindow* window) {
  return *static_cast<std::vector<WindowEvent>*>(glfwGetWindowUserPointer(window));
}

[[noreturn]] void fail(const std::string& problem) {
  const char* reason = nullptr;
  glfwGetError(&reason);
  glfwTerminate();
  throw Error("window", problem + (reason != nullptr ? std::string(": ") + reason : ""),
              "start it on a machine with a display and OpenGL 4.5, or use `ergodome render`");
}

}  // namespace

Window::Window(int width, int height, const std::string& title, bool full_screen, WindowBuffers buffers)
    : state_(std::make_unique<State>()) {
  if (glfwInit() == GLFW_FALSE) {
    fail("there is no display");
  }
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_STEREO, buffers == WindowBuffers::stereo ? GLFW_TRUE : GLFW_FALSE);
  state_->window = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (state_->window == nullptr && buffers == WindowBuffers::stereo) {
    // GLFW fails to open a window if a requested stereo buffer is not available.
    glfwWindowHint(GLFW_STEREO, GLFW_FALSE);
    state_->window = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  }
  if (state_->window == nullptr) {
    fail("cannot be opened");
  }
  glfwMakeContextCurrent(state_->window);
  GLboolean has_eyes = GL_FALSE;
  glGetBooleanv(GL_STEREO, &has_eyes);
  state_->buffers =
      buffers == WindowBuffers::stereo && has_eyes == GL_TRUE ? WindowBuffers::stereo : WindowBuffers::plain;
  glfwSwapInterval(1);
  glfwSetWindowUserPointer(state_->window, &state_->events);
  glfwSetKeyCallback(state_->window, [](GLFWwindow* window, int key, int, int action, int) {
    if (action != GLFW_REPEAT) {
      events_of(window).push_back(
          {action == GLFW_PRESS ? WindowEvent::Kind::key_down : WindowEvent::Kind::key_up, key, 0.0, 0.0});
    }
  });
  glfwSetMouseButtonCallback(state_->window, [](GLFWwindow* window, int button, int action, int) {
    events_of(window).push_back(
        {action == GLFW_PRESS ? WindowEvent::Kind::button_down : WindowEvent::Kind::button_up, button, 0.0, 0.0});
  });
  // Stores positions, which events() turns into movements.
  glfwSetCursorPosCallback(state_->window, [](GLFWwindow* window, double x, double y) {
    events_of(window).push_back({WindowEvent::Kind::pointer, 0, x, y});
  });
  glfwSetScrollCallback(state_->window, [](GLFWwindow* window, double dx, double dy) {
    events_of(window).push_back({WindowEvent::Kind::scroll, 0, dx, dy});
  });
  if (full_screen) {
    toggle_full_screen();
  }
}

Window::~Window() {
  glfwDestroyWindow(state_->window);
  glfwTerminate();
}

std::vector<WindowEvent> Window::events(double seconds) {
  glfwWaitEventsTimeout(seconds);
  std::vector<WindowEvent> since;
  since.swap(state_->events);
  for (WindowEvent& event : since) {
    if (event.kind == WindowEvent::Kind::pointer) {
      const std::pair position(event.dx, event.dy);
      const auto [x, y] = state_->pointer.value_or(position);
      event.dx -= x;
      event.dy -= y;
      state_->pointer = position;
    }
  }
  return since;
}

WindowBuffers Window::buffers() const { return state_->buffers; }

void Window::draw_into(WindowEye eye) {
  glDrawBuffer(eye == WindowEye::left ? GL_BACK_LEFT : eye == WindowEye::right ? GL_BACK_RIGHT : GL_BACK);
}

void Window::swap() { glfwSwapBuffers(state_->window); }

void Window::toggle_full_screen() {
  int(&w)[4] = state_->windowed;
  if (glfwGetWindowMonitor(state_->window) != nullptr) {
    glfwSetWindowMonitor(state_->window, nullptr, w[0], w[1], w[2], w[3], GLFW_DONT_CARE);
    return;
  }
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
  if (mode == nullptr) {
    return;  // no monitor to fill
  }
  glfwGetWindowPos(state_->window, &w[0], &w[1]);
  glfwGetWindowSize(state_->window, &w[2], &w[3]);
  glfwSetWindowMonitor(state_->window, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

void Window::set_title(const std::string& title) { glfwSetWindowTitle(state_->window, title.c_str()); }

void Window::close() { glfwSetWindowShouldClose(state_->window, GLFW_TRUE); }

bool Window::closed() const { return glfwWindowShouldClose(state_->window) == GLFW_TRUE; }

void Window::keep_in_front() {
  glfwSetWindowAttrib(state_->window, GLFW_FLOATING, GLFW_TRUE);
  glfwFocusWindow(state_->window);
}

void Window::hide() { glfwHideWindow(state_->window); }

void Window::hide_cursor() {
  show_cursor(false);
  state_->without_cursor = true;
}

void Window::show_cursor(bool shown) {
  if (!state_->without_cursor) {
    glfwSetInputMode(state_->window, GLFW_CURSOR, shown ? GLFW_CURSOR_NORMAL : GLFW_CURSOR_HIDDEN);
  }
}

void Window::move_to_monitor(int monitor) {
  int count = 0;
  GLFWmonitor** const monitors = glfwGetMonitors(&count);
  if (monitor < 0 || monitor >= count) {
    return;
  }
  int x = 0;
  int y = 0;
  glfwGetMonitorWorkarea(monitors[monitor], &x, &y, nullptr, nullptr);
  constexpr int title_bar_px = 40;
  glfwSetWindowPos(state_->window, x, y + title_bar_px);
}

DesktopRectangle Window::rectangle() const {
  DesktopRectangle inside;
  glfwGetWindowPos(state_->window, &inside.x_px, &inside.y_px);
  glfwGetWindowSize(state_->window, &inside.width_px, &inside.height_px);
  int left = 0;
  int top = 0;
  int right = 0;
  int bottom = 0;
  glfwGetWindowFrameSize(state_->window, &left, &top, &right, &bottom);
  return {inside.x_px - left, inside.y_px - top, inside.width_px + left + right, inside.height_px + top + bottom};
}

void Window::move_to(const DesktopRectangle& position) {
  int left = 0;
  int top = 0;
  glfwGetWindowFrameSize(state_->window, &left, &top, nullptr, nullptr);
  glfwSetWindowPos(state_->window, position.x_px + left, position.y_px + top);
}

void Window::make_current() { glfwMakeContextCurrent(state_->window); }

void Window::swap_at_once() { glfwSwapInterval(0); }

void* Window::handle() const { return state_->window; }

void Window::framebuffer_size(int& width, int& height) const {
  glfwGetFramebufferSize(state_->window, &width, &height);
}

}  // namespace ergodome
