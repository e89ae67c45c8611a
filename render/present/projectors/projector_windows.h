#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "calibration/projectors/projector_picture.h"
#include "render/present/presenter.h"
#include "render/present/window.h"

// Shows a domemaster in the windows of a dome's projectors.

namespace ergodome {

//! Whether warps change while the windows exist. Warps that change are always drawn by OpenGL,
//! because kernels need a second of CPU time to prepare each one.
enum class WarpUse { fixed, adjusted };

//! The windows of a dome's projectors, which show one domemaster. The domemaster is stored once on
//! the GPU, in the control window's context. The CPU draws the projectors' images if OpenGL has no
//! GPU. CUDA draws them if CUDA rendered the picture, until warps are changed.
class ProjectorWindows {
 public:
  //! `control` must outlive this object, and its context stays current. The window is moved to a
  //! monitor that no projector fills, beside the projectors' windows there if there is room, and is
  //! kept in front of them. Without such a monitor, or with `hide_control`, it is hidden. Throws
  //! Error if a monitor is missing, or if a projector's window would lie outside all monitors or
  //! cannot be opened.
  ProjectorWindows(Window& control, const DomeSetup& setup, const std::vector<ProjectorPicture>& pictures,
                   bool hide_control, WarpUse use = WarpUse::fixed);
  ~ProjectorWindows();
  ProjectorWindows(const ProjectorWindows&) = delete;
  ProjectorWindows& operator=(const ProjectorWindows&) = delete;

  //! Must be called when the control window's presenter has a new picture. `picture` is a copy of
  //! it in CUDA memory, if there is one; CUDA computes its display light before this function
  //! returns. After a change of size, OpenGL draws 119 pictures first.
  void take(const DevicePicture* picture);

  //! Draws the presenter's picture `master` in all windows, then shows them all; the first one
  //! waits for its display's refresh.
  void show(const PresentedPicture& master);

  //! Sets the captions that are composited over the domemaster, which contains no captions itself.
  //! Without a layer, removes them. Captions have the layer's resolution.
  void lay_over(const LaidCaptions& captions);

  //! Replaces a projector's warp, offsets and colors, but not its masks. OpenGL draws its image
  //! from now on.
  void change(std::size_t projector, const ProjectorPicture& picture);

  //! Replaces a projector's warp, colors and masks. OpenGL draws its image from now on.
  void replace(std::size_t projector, const ProjectorPicture& picture);

  //! Sets the text that is shown over a projector's image; empty: none.
  void set_text(std::size_t projector, const std::string& text);

  //! Shows a raster instead of a projector's image of the domemaster; nullptr ends this.
  void set_raster(std::size_t projector, const Picture* raster);

  //! Lets the windows join the swap group of a dome of several computers, or leave it. Returns why
  //! that is not possible; otherwise an empty text.
  [[nodiscard]] std::string join_swap_group(bool joined);

  //! Returns the input events of the windows since the last call.
  std::vector<WindowEvent> events();

  //! Returns whether one of the windows was closed.
  [[nodiscard]] bool closed() const;

  //! Returns whether the control window is visible.
  [[nodiscard]] bool control_shown() const;

  //! Writes the windows' contents as FILE_PROJECTOR.png for FILE.png. `names`: the projectors'
  //! names in file names.
  void save_screenshots(const std::filesystem::path& file, const std::vector<std::string>& names);

 private:
  struct State;
  void draw(std::size_t projector);
  //! Returns whether kernels can draw a projector's image: its window must have the size of the
  //! image, and the warp must not have changed, because kernels need a second of CPU time to
  //! prepare one.
  [[nodiscard]] bool may_draw_by_kernels(std::size_t projector) const;

  //! Computes the display light or the rasters for a new domemaster.
  void update(const PresentedPicture& master);
  //! Draws the rasters with CUDA and uploads those of the projectors `by_kernels`. Returns false if
  //! CUDA has no light of the current picture, if `by_kernels` is empty, or if CUDA fails; in the
  //! last case it is not used again.
  bool update_by_cuda(const PresentedPicture& master, const std::vector<std::size_t>& by_kernels);
  //! Uploads the raster that kernels drew to the projector's window. Rasters of the CPU are drawn
  //! here.
  void send(std::size_t projector);
  void update_light(const PresentedPicture& master);
  void leave_others_to_opengl(const PresentedPicture& master, const std::vector<std::size_t>& by_kernels);
  void give_up_cuda();

  //! Makes OpenGL draw a projector's image from now on; the context of the projector's window must
  //! be current.
  void draw_by_opengl(std::size_t projector);

  std::unique_ptr<State> state_;
};

}  // namespace ergodome
