#pragma once

#include <memory>
#include <string>
#include <vector>

#include "render/present/desktop.h"

namespace ergodome {

//! Something that a person did to the window.
struct WindowEvent {
  enum class Kind { key_down, key_up, button_down, button_up, pointer, scroll };
  Kind kind;
  int key = 0;      //!< GLFW's number of the key, or of the mouse's button
  double dx = 0.0;  //!< pointer: pixels to the right; scroll: steps
  double dy = 0.0;  //!< pointer: pixels downwards; scroll: steps upwards
};

//! What windows are made of: one buffer for both eyes, or one for each where the driver has them (quad buffer).
enum class WindowBuffers { plain, stereo };

//! Which buffer of a window is drawn into.
enum class WindowEye { both, left, right };

//! A window with an OpenGL 4.5 core context, current on the thread that makes it.
class Window {
 public:
  //! Throws Error where there is no display or no OpenGL 4.5. A driver without buffers for each eye makes a plain window.
  Window(int width, int height, const std::string& title, bool full_screen,
         WindowBuffers buffers = WindowBuffers::plain);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  //! Waits up to `seconds` for events and returns those that came.
  std::vector<WindowEvent> events(double seconds);

  //! What the window was made of.
  [[nodiscard]] WindowBuffers buffers() const;

  //! Draw from here on into the buffer of an eye; `both` where the window is plain.
  void draw_into(WindowEye eye);

  //! Shows what was drawn, in step with the display.
  void swap();

  void toggle_full_screen();
  void set_title(const std::string& title);
  void close();
  [[nodiscard]] bool closed() const;

  //! Keeps it above other windows, and in front of them now.
  void keep_in_front();

  //! Takes it off the screen; its context stays.
  void hide();

  //! Takes the cursor out of the picture, for good.
  void hide_cursor();

  //! Shows the cursor or not, unless it is hidden for good.
  void show_cursor(bool shown);

  //! Moves it to the top left of a monitor, counted from 0.
  void move_to_monitor(int monitor);

  //! Where it is, with the frame that a window manager gives it.
  [[nodiscard]] DesktopRectangle rectangle() const;

  //! Moves it, its frame's top left corner to there. A full screen stays.
  void move_to(const DesktopRectangle& place);

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
