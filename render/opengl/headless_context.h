#pragma once

#include <cstdint>
#include <memory>
#include <vector>

// Draws with OpenGL without a window or a display.

namespace ergodome {

//! An OpenGL 4.5 core context without a window or a display, through EGL: on the device platform of
//! a GPU driver if there is one, otherwise on Mesa's surfaceless platform. It is current on the
//! thread that creates it, as long as it exists.
class HeadlessContext {
 public:
  //! Throws Error if no EGL driver offers OpenGL 4.5.
  HeadlessContext();
  ~HeadlessContext();
  HeadlessContext(const HeadlessContext&) = delete;
  HeadlessContext& operator=(const HeadlessContext&) = delete;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

//! Returns the bound framebuffer's pixels as RGB bytes, top row first.
std::vector<std::uint8_t> read_framebuffer(int width, int height);

//! A framebuffer without a window, with eight bits per channel, in the current context.
class OffscreenFrame {
 public:
  //! Throws Error if the size exceeds the driver's limit, or if memory is insufficient.
  OffscreenFrame(int width, int height);
  ~OffscreenFrame();
  OffscreenFrame(const OffscreenFrame&) = delete;
  OffscreenFrame& operator=(const OffscreenFrame&) = delete;

  //! Directs subsequent drawing to this framebuffer.
  void bind() const;

  //! Binds this framebuffer and returns its contents as RGB bytes, top row first.
  [[nodiscard]] std::vector<std::uint8_t> read_back() const;

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

 private:
  int width_;
  int height_;
  unsigned texture_ = 0;
  unsigned framebuffer_ = 0;
};

}  // namespace ergodome
