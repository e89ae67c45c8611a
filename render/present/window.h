#pragma once

#include <memory>
#include <string>
#include <vector>

namespace ergodome {

//! Something that a person did to the window.
struct WindowEvent {
  enum class Kind { key_down, key_up, drag, scroll };
  Kind kind;
  int key = 0;      //!< GLFW's number of the key
  double dx = 0.0;  //!< drag: pixels to the right with the mouse button down; scroll: steps
  double dy = 0.0;  //!< drag: pixels downwards; scroll: steps upwards
};

//! A window with an OpenGL 4.5 core context, current on the thread that makes it.
class Window {
 public:
  //! Throws Error where there is no display or no OpenGL 4.5.
  Window(int width, int height, const std::string& title, bool full_screen);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  //! Waits up to `seconds` for events and returns those that came.
  std::vector<WindowEvent> events(double seconds);

  //! Shows what was drawn, in step with the display.
  void swap();

  void toggle_full_screen();
  void set_title(const std::string& title);
  void close();
  [[nodiscard]] bool closed() const;

  //! Takes it off the screen; its context stays.
  void hide();

  //! Moves it to the top left of a monitor, counted from 0.
  void move_to_monitor(int monitor);

  //! Makes its context the current one, after another window's.
  void make_current();

  //! From now on swap() waits for no display: another window does.
  void swap_at_once();

  //! GLFW's window, for windows that share its context.
  [[nodiscard]] void* handle() const;

  //! Size of the framebuffer in pixels; 0 x 0 while minimized.
  void framebuffer_size(int& width, int& height) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ergodome
