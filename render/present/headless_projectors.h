#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "calibration/projector_picture.h"
#include "render/frame/eye_renderer.h"

namespace ergodome {

//! Draws what the projectors of a dome show without a window or a display, through EGL.
class HeadlessProjectors {
 public:
  //! Throws Error where no driver gives OpenGL 4.5 without a display, or one has no room for a raster.
  explicit HeadlessProjectors(const std::vector<ProjectorPicture>& pictures);
  ~HeadlessProjectors();
  HeadlessProjectors(const HeadlessProjectors&) = delete;
  HeadlessProjectors& operator=(const HeadlessProjectors&) = delete;

  //! Takes over a domemaster, in linear light; it stays until the next one.
  void show(const Picture& master);

  //! What a projector shows of it: the values that it is sent, RGB bytes of its resolution, the top row first.
  std::vector<std::uint8_t> frame(std::size_t projector);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ergodome
