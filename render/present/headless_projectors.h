#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "calibration/projector_picture.h"
#include "render/present/software_projectors.h"

namespace ergodome {

//! Who draws what projectors show without a window: OpenGL on a GPU, else the processor; one of them in any case.
enum class ProjectorDrawer { automatic, opengl, processor };

//! Draws what the projectors of a dome show without a window or a display: OpenGL through EGL where there is a GPU, else the processor.
class HeadlessProjectors {
 public:
  //! Throws Error where OpenGL is asked for and no driver gives version 4.5 without a display, and where a GPU has no room for a raster.
  explicit HeadlessProjectors(const std::vector<ProjectorPicture>& pictures,
                              ProjectorDrawer drawer = ProjectorDrawer::automatic);
  ~HeadlessProjectors();
  HeadlessProjectors(const HeadlessProjectors&) = delete;
  HeadlessProjectors& operator=(const HeadlessProjectors&) = delete;

  //! Takes over a domemaster, in linear light; it stays until the next one.
  void show(const Picture& master);

  //! What a projector shows of it: the values that it is sent, RGB bytes of its resolution, the top row first.
  std::vector<std::uint8_t> frame(std::size_t projector);

 private:
  struct OpenGl;
  std::unique_ptr<OpenGl> opengl_;
  std::unique_ptr<SoftwareProjectors> software_;  //!< the one or the other
};

}  // namespace ergodome
