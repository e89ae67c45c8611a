#pragma once

#include <cstdint>
#include <vector>

namespace ergodome {

//! A framebuffer without a window, eight bits a channel, in the current context.
class OffscreenFrame {
 public:
  //! Throws Error where the driver has no room for that size.
  OffscreenFrame(int width, int height);
  ~OffscreenFrame();
  OffscreenFrame(const OffscreenFrame&) = delete;
  OffscreenFrame& operator=(const OffscreenFrame&) = delete;

  //! Makes what is drawn from now on go here.
  void bind() const;

  //! What was drawn, RGB bytes, the top row first.
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
