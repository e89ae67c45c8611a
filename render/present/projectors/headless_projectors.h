#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "calibration/projectors/projector_picture.h"
#include "render/present/projectors/software_projectors.h"

namespace ergodome {

//! Who draws what projectors show without a window: OpenGL on a GPU, else the processor; one of them in any case; or CUDA, where it can be used,
//! else as if nobody were asked for.
enum class ProjectorDrawer { automatic, opengl, processor, cuda };

//! Draws what the projectors of a dome show without a window or a display: OpenGL through EGL where there is a GPU, else the processor; for
//! pictures that CUDA makes, CUDA, whose devices may draw by OpenGL on few of their units.
class HeadlessProjectors {
 public:
  //! Throws Error where OpenGL is asked for and no driver gives version 4.5 without a display, and where a GPU has no room for OpenGL's rasters.
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
  void open_without_cuda(const std::vector<ProjectorPicture>& pictures, ProjectorDrawer drawer);
  //! Whether CUDA has drawn a master. Where it fails, others draw from then on.
  bool show_by_cuda(const Picture& master);

  std::unique_ptr<SoftwareProjectors> cuda_;
  std::unique_ptr<OpenGl> opengl_;
  std::unique_ptr<SoftwareProjectors> software_;  //!< one of the three
};

}  // namespace ergodome
