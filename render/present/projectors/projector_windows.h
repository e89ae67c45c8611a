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

//! Whether warps change. Adjusted warps are drawn by OpenGL from the start, because kernels need a
//! second of CPU time to prepare each.
enum class WarpUse { fixed, adjusted };

//! The windows of a dome's projectors, which show one domemaster. The master is on the GPU once, in
//! the control window's context. Without a GPU for OpenGL, the CPU draws the projectors' images;
//! for pictures made by CUDA, CUDA does, until warps are changed.
class ProjectorWindows {
 public:
  //! `control` must outlive this object, and stays current. It moves to a monitor that no projector
  //! fills, next to existing windows if there is room, and stays in front of them. Without such a
  //! monitor, or with `hide_control`, it is hidden. Throws Error if a monitor is missing, or if a
  //! window would lie outside all monitors or cannot be opened.
  ProjectorWindows(Window& control, const DomeSetup& setup, const std::vector<ProjectorPicture>& pictures,
                   bool hide_control, WarpUse use = WarpUse::fixed);
  ~ProjectorWindows();
  ProjectorWindows(const ProjectorWindows&) = delete;
  ProjectorWindows& operator=(const ProjectorWindows&) = delete;

  //! Reports a new picture in the control window's presenter. `picture` is its copy in CUDA memory,
  //! if there is one; CUDA draws from it before this returns.
  void take(const DevicePicture* picture);

  //! Draws a picture of the control window's presenter in all windows, then shows them all, the
  //! first synchronized with its display.
  void show(const PresentedPicture& master);

  //! Sets the captions over the master, which contains no captions itself; without a layer it
  //! removes them. Captions have the layer's resolution.
  void lay_over(const LaidCaptions& captions);

  //! Replaces a projector's warp, corners and colors; its masks stay.
  void change(std::size_t projector, const ProjectorPicture& picture);

  //! Replaces a projector's picture including its masks.
  void replace(std::size_t projector, const ProjectorPicture& picture);

  //! Sets the text over a projector's picture; none if empty.
  void set_text(std::size_t projector, const std::string& text);

  //! Shows a raster instead of a projector's part of the master; nullptr ends this.
  void set_raster(std::size_t projector, const Picture* raster);

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
  //! Returns whether a projector's window has the size of its picture and the picture was not
  //! changed: kernels need a second of CPU time to prepare a warp.
  [[nodiscard]] bool may_draw_by_kernels(std::size_t projector) const;

  //! Computes light or rasters of a new master.
  void update(const PresentedPicture& master);
  //! Draws the rasters of these projectors with CUDA. Returns false if CUDA fails; it is then not
  //! used again.
  bool update_by_cuda(const PresentedPicture& master, const std::vector<std::size_t>& by_kernels);
  //! Draws a raster and uploads it to its window.
  void send(std::size_t projector);
  void update_light(const PresentedPicture& master);
  void leave_others_to_opengl(const PresentedPicture& master, const std::vector<std::size_t>& by_kernels);
  void give_up_cuda();

  //! Switches a projector to OpenGL; its context must be current.
  void draw_by_opengl(std::size_t projector);

  std::unique_ptr<State> state_;
};

}  // namespace ergodome
