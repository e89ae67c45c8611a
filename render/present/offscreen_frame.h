#pragma once

#include <cstdint>
#include <vector>

namespace ergodome {

//! A framebuffer without a window, with eight bits per channel, in the current context.
class OffscreenFrame {
 public:
  //! Throws Error if the driver lacks memory for this size.
  OffscreenFrame(int width, int height);
  ~OffscreenFrame();
  OffscreenFrame(const OffscreenFrame&) = delete;
  OffscreenFrame& operator=(const OffscreenFrame&) = delete;

  //! Directs subsequent drawing to this framebuffer.
  void bind() const;

  //! Returns the contents as RGB bytes, top row first.
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
