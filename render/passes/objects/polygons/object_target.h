#pragma once

#include <vector>

namespace ergodome {

//! Multisampled render target for objects in the current OpenGL context: light and coverage, and
//! depth.
class ObjectTarget {
 public:
  //! Throws Error if the driver cannot allocate memory.
  ObjectTarget(int width, int height);
  ~ObjectTarget();
  ObjectTarget(const ObjectTarget&) = delete;
  ObjectTarget& operator=(const ObjectTarget&) = delete;

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

  //! Binds the target and clears it to no light, no coverage and maximum depth.
  void begin() const;

  //! Reads the drawn pixels: light times coverage, and coverage; four floats per pixel, bottom row
  //! first.
  void read(std::vector<float>& rgba) const;

  static constexpr int samples = 4;
  //! Maximum width and height of the tiles in which pictures are drawn, to limit memory [px].
  static constexpr int longest_side_px = 2048;
  //! Returns the memory of a target [bytes]: four halves and a depth per sample, and four halves
  //! per pixel of the resolved picture.
  static constexpr long bytes_for(int width, int height) {
    return static_cast<long>(width) * height * (samples * (8L + 4L) + 8L);
  }

 private:
  int width_;
  int height_;
  unsigned light_ = 0;
  unsigned depth_ = 0;
  unsigned framebuffer_ = 0;
  unsigned resolved_ = 0;
  unsigned resolved_framebuffer_ = 0;
};

}  // namespace ergodome
