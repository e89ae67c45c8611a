#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "calibration/projectors/projector_picture.h"
#include "render/present/projectors/software_projectors.h"

// Draws projector images without a window.

namespace ergodome {

//! How projector images are drawn without a window. `automatic`: with OpenGL if a GPU supports it,
//! otherwise on the CPU. `opengl` and `processor` (the CPU): always in that way. `cuda`: with CUDA
//! if available, otherwise like `automatic`.
enum class ProjectorDrawer { automatic, opengl, processor, cuda };

//! Draws a dome's projector images without a window or a display: with OpenGL through EGL on a GPU,
//! otherwise on the CPU. ProjectorDrawer::cuda is meant for pictures that CUDA rendered, because
//! such GPUs may have few units for OpenGL.
class HeadlessProjectors {
 public:
  //! Throws Error if OpenGL is requested and no driver offers version 4.5 without a display, or if
  //! a GPU lacks memory for OpenGL's rasters.
  explicit HeadlessProjectors(const std::vector<ProjectorPicture>& pictures,
                              ProjectorDrawer drawer = ProjectorDrawer::automatic);
  ~HeadlessProjectors();
  HeadlessProjectors(const HeadlessProjectors&) = delete;
  HeadlessProjectors& operator=(const HeadlessProjectors&) = delete;

  //! Sets the domemaster, in linear light, which is used until the next call.
  void show(const Picture& master);

  //! Returns the image that a projector shows of the domemaster: RGB bytes of the projector's
  //! resolution, top row first.
  std::vector<std::uint8_t> frame(std::size_t projector);

 private:
  struct OpenGl;
  void open_without_cuda(const std::vector<ProjectorPicture>& pictures, ProjectorDrawer drawer);
  //! Draws a domemaster with CUDA. Returns false if CUDA is not in use or fails; in the second
  //! case, drawing changes to ProjectorDrawer::automatic for good.
  bool show_by_cuda(const Picture& master);

  std::unique_ptr<SoftwareProjectors> cuda_;
  std::unique_ptr<OpenGl> opengl_;
  //! Exactly one of this and the two preceding members is in use.
  std::unique_ptr<SoftwareProjectors> software_;
};

}  // namespace ergodome
