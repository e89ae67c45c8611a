#pragma once

#include <vector>

namespace ergodome {

//! What objects are drawn on: light and coverage with several samples a pixel, and a depth. In the current OpenGL context.
class ObjectTarget {
 public:
  //! Throws Error where the driver has no room for it.
  ObjectTarget(int width, int height);
  ~ObjectTarget();
  ObjectTarget(const ObjectTarget&) = delete;
  ObjectTarget& operator=(const ObjectTarget&) = delete;

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

  //! Binds it, and clears it to no light, no coverage and the farthest depth.
  void begin() const;

  //! Light times coverage, and coverage: four floats a pixel, the bottom row first.
  void read(std::vector<float>& rgba) const;

  static constexpr int samples = 4;
  //! A picture is drawn in squares of this side, so that memory stays bounded.
  static constexpr int longest_side_px = 2048;
  //! Of a target: four halves and a depth a sample, and four halves once more.
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
