#pragma once

#include <memory>
#include <string>
#include <vector>

#include "render/present/desktop.h"

// OpenGL windows and their input events.

namespace ergodome {

//! An input event of a window: a key, a mouse button, a motion of the pointer, or scrolling.
struct WindowEvent {
  enum class Kind { key_down, key_up, button_down, button_up, pointer, scroll };
  Kind kind;
  int key = 0;      //!< GLFW's code of the key or mouse button
  double dx = 0.0;  //!< pointer: pixels to the right; scroll: steps
  double dy = 0.0;  //!< pointer: pixels downwards; scroll: steps upwards
};

//! Framebuffers of a window: one for both eyes, or one per eye if the driver supports it (quad
//! buffer).
enum class WindowBuffers { plain, stereo };

//! The buffer of a window to draw into.
enum class WindowEye { both, left, right };

//! A window with an OpenGL 4.5 core context, current on the thread that creates it.
class Window {
 public:
  //! Throws Error without a display or OpenGL 4.5. If the driver has no buffers per eye, creates a
  //! plain window.
  Window(int width, int height, const std::string& title, bool full_screen,
         WindowBuffers buffers = WindowBuffers::plain);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  //! Waits up to `seconds` for events and returns all that arrived.
  std::vector<WindowEvent> events(double seconds);

  //! Returns which kind of buffers the window has.
  [[nodiscard]] WindowBuffers buffers() const;

  //! Selects the buffer of an eye for drawing; `both` in a plain window.
  void draw_into(WindowEye eye);

  //! Shows what was drawn; waits for the display's refresh unless swap_at_once() was called.
  void swap();

  void toggle_full_screen();
  void set_title(const std::string& title);
  void close();
  [[nodiscard]] bool closed() const;

  //! Keeps the window above other windows and gives it the input focus.
  void keep_in_front();

  //! Hides the window; its OpenGL context stays valid.
  void hide();

  //! Hides the cursor permanently.
  void hide_cursor();

  //! Shows or hides the cursor, unless it is hidden permanently.
  void show_cursor(bool shown);

  //! Moves the window to the top left of a monitor's work area, 40 px down for its title bar.
  //! Monitors count from 0; does nothing if there is none with this number.
  void move_to_monitor(int monitor);

  //! Returns the window's rectangle, including the frame of the window manager.
  [[nodiscard]] DesktopRectangle rectangle() const;

  //! Moves the top left corner of the window's frame to that of `position`. Does not move a
  //! full-screen window.
  void move_to(const DesktopRectangle& position);

  //! Makes the window's OpenGL context current again, for example after another window's was.
  void make_current();

  //! Makes swap() return without waiting for the display, for windows shown together with another
  //! one that waits.
  void swap_at_once();

  //! Returns the GLFWwindow, so that other windows can share its context.
  [[nodiscard]] void* handle() const;

  //! Returns the size of the framebuffer in pixels; 0 x 0 while minimized.
  void framebuffer_size(int& width, int& height) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ergodome
