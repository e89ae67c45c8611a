#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "calibration/projectors/projector_picture.h"
#include "render/present/presenter.h"
#include "render/present/window.h"

namespace ergodome {

//! Whether warps stay. Adjusted ones are drawn by OpenGL from the start: the processor needs a second to prepare each.
enum class WarpUse { fixed, adjusted };

//! The windows of a dome's projectors, which show one domemaster. It is on the GPU once, in the control window's context. Where OpenGL has
//! no GPU the processor draws what the projectors are sent, and of pictures that CUDA has made CUDA, until their warps are changed.
class ProjectorWindows {
 public:
  //! `control` must outlive it, and stays current. It moves to a monitor that no projector fills, beside windows that are there if there is
  //! room, and stays in front of them; without such a monitor, or with `hide_control`, it is not seen. Throws Error where a monitor is missing, or a window would lie
  //! beside all of them or cannot be opened.
  ProjectorWindows(Window& control, const DomeSetup& setup, const std::vector<ProjectorPicture>& pictures,
                   bool hide_control, WarpUse use = WarpUse::fixed);
  ~ProjectorWindows();
  ProjectorWindows(const ProjectorWindows&) = delete;
  ProjectorWindows& operator=(const ProjectorWindows&) = delete;

  //! Says that the control window's presenter was handed over a picture, and where CUDA has it, if it has. CUDA draws from it, which may go then.
  void take(const DevicePicture* picture);

  //! Draws a picture of the control window's presenter in all windows, then shows it in all of them, the first in step with its display.
  void show(const PresentedPicture& master);

  //! Captions to lay over the master, which has none of its own; none if there is no layer. They are drawn with the layer's resolution.
  void lay_over(const LaidCaptions& captions);

  //! Takes over a projector's warp, corners and colours; its masks stay.
  void change(std::size_t projector, const ProjectorPicture& picture);

  //! Takes over a projector's picture with its masks.
  void replace(std::size_t projector, const ProjectorPicture& picture);

  //! Text over a projector's picture; none where it is empty.
  void set_text(std::size_t projector, const std::string& text);

  //! A raster of its own in place of a projector's part of the master; nothing where `raster` is null.
  void set_raster(std::size_t projector, const Picture* raster);

  //! What was done to the windows since the last call.
  std::vector<WindowEvent> events();

  //! Whether one of them was closed.
  [[nodiscard]] bool closed() const;

  //! Whether the control window is to be seen.
  [[nodiscard]] bool control_shown() const;

  //! Writes what the windows show as FILE_PROJECTOR.png for FILE.png. `names`: the projectors' for files.
  void save_screenshots(const std::filesystem::path& file, const std::vector<std::string>& names);

 private:
  struct State;
  void draw(std::size_t projector);
  //! Whether a projector's window is as large as its picture, which was not changed: a warp takes the processor a second to work out.
  [[nodiscard]] bool may_draw_by_kernels(std::size_t projector) const;

  //! Makes light or rasters of a new master.
  void update(const PresentedPicture& master);
  //! Whether CUDA has made the rasters of these projectors. Where it fails, others do from then on.
  bool update_by_cuda(const PresentedPicture& master, const std::vector<std::size_t>& by_kernels);
  //! Draws a raster, and hands it over to its window.
  void send(std::size_t projector);
  void update_light(const PresentedPicture& master);
  void leave_others_to_opengl(const PresentedPicture& master, const std::vector<std::size_t>& by_kernels);
  void give_up_cuda();

  //! From now on; its context must be current.
  void draw_by_opengl(std::size_t projector);

  std::unique_ptr<State> state_;
};

}  // namespace ergodome
