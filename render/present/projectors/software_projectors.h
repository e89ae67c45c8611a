#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "render/present/projectors/projector_warp.h"

namespace ergodome {

//! Draws a dome's projector images with kernels, without OpenGL. On the CPU this is several times
//! faster than software OpenGL; on a CUDA GPU, domemasters need not leave GPU memory. Members throw
//! Error if the GPU fails or is out of memory.
class SoftwareProjectors {
 public:
  explicit SoftwareProjectors(std::vector<ProjectorPicture> pictures, Backend backend = Backend::cpu)
      : backend_(backend), pictures_(std::move(pictures)), rasters_(pictures_.size()) {}

  //! Sets the domemaster, in linear light, which is used until the next call. The first call, and
  //! one with another size, takes longer.
  void show(const Picture& master);

  //! Sets a domemaster in the backend's memory. A GPU may read it until the next draw_in_place() or
  //! frame() returns.
  void show_in_place(const MasterPicture& master);

  //! Returns whether a domemaster of this size requires that warps are computed again.
  [[nodiscard]] bool has_other_warps(int width, int height) const;

  //! Sets the factor on the light of everything drawn, 0 to 1.
  void set_light(float light) { shown_light_ = light; }

  //! Replaces a projector's warp, masks and colors; used from the next domemaster on.
  void replace(std::size_t projector, const ProjectorPicture& picture);

  //! Returns the image that a projector shows of the domemaster: RGB bytes of the projector's
  //! resolution, top row first.
  [[nodiscard]] std::vector<std::uint8_t> frame(std::size_t projector);

  //! Writes the image that a projector shows of the domemaster to host memory, which must have the
  //! image's size.
  void frame(std::size_t projector, std::uint8_t* rgb);

  //! Draws all projectors' images into rasters in the backend's memory; waits for the GPU once.
  void draw_in_place();

  //! raster() returns a projector's last image in the backend's memory, read_raster() a copy of it
  //! in host memory.
  [[nodiscard]] const std::uint8_t* raster(std::size_t projector) const { return rasters_[projector].data(); }
  [[nodiscard]] std::vector<std::uint8_t> read_raster(std::size_t projector) const;

  [[nodiscard]] const ProjectorPicture& picture(std::size_t projector) const { return pictures_[projector]; }
  [[nodiscard]] const std::vector<ProjectorPicture>& pictures() const { return pictures_; }

 private:
  //! Computes warps that are missing, or all of them if the domemaster's size has changed.
  void prepare(int width, int height);
  [[nodiscard]] std::size_t raster_bytes(std::size_t projector) const;
  //! Draws a projector's image. Does not wait for a GPU.
  void draw_raster(std::size_t projector);

  Backend backend_;
  std::vector<ProjectorPicture> pictures_;
  std::vector<std::optional<ProjectorWarp>> warps_;
  MasterLight light_;
  float shown_light_ = 1.0F;
  Buffer<float> master_;  //!< copy of a domemaster from host memory, for the GPU
  std::vector<Buffer<std::uint8_t>> rasters_;
};

}  // namespace ergodome
