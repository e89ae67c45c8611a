#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "render/present/projectors/projector_warp.h"

namespace ergodome {

//! Draws what the projectors of a dome show by kernels, without OpenGL: on the processor, several times as fast as OpenGL in software, or on a
//! CUDA device, where masters that lie there need not leave it. Its members throw Error where a device fails or has no room.
class SoftwareProjectors {
 public:
  explicit SoftwareProjectors(std::vector<ProjectorPicture> pictures, Backend backend = Backend::cpu)
      : backend_(backend), pictures_(std::move(pictures)), rasters_(pictures_.size()) {}

  //! Takes over a domemaster, in linear light; it stays until the next one. The first, and one of another size, takes longer.
  void show(const Picture& master);

  //! The same of one that lies in the backend's memory. A device may read it until the next draw_in_place() or frame() returns.
  void show_in_place(const MasterPicture& master);

  //! Whether a master of a size makes it work all warps out anew.
  [[nodiscard]] bool has_other_warps(int width, int height) const;

  //! Factor on the light of all that is drawn from now on, 0 to 1.
  void set_light(float light) { shown_light_ = light; }

  //! Takes over a projector's picture; the next master shows it.
  void replace(std::size_t projector, const ProjectorPicture& picture);

  //! What a projector shows of the master: the values that it is sent, RGB bytes of its resolution, the top row first.
  [[nodiscard]] std::vector<std::uint8_t> frame(std::size_t projector);

  //! The same, into host memory of that size.
  void frame(std::size_t projector, std::uint8_t* rgb);

  //! Draws the same of all projectors into rasters that stay in the backend's memory; a device is waited for once.
  void draw_in_place();

  //! What was drawn there of a projector last, in the backend's memory and copied from it.
  [[nodiscard]] const std::uint8_t* raster(std::size_t projector) const { return rasters_[projector].data(); }
  [[nodiscard]] std::vector<std::uint8_t> read_raster(std::size_t projector) const;

  [[nodiscard]] const ProjectorPicture& picture(std::size_t projector) const { return pictures_[projector]; }
  [[nodiscard]] const std::vector<ProjectorPicture>& pictures() const { return pictures_; }

 private:
  //! Works out warps that are missing, or all for another size.
  void prepare(int width, int height);
  [[nodiscard]] std::size_t raster_bytes(std::size_t projector) const;
  //! Does not wait for a device.
  void draw_raster(std::size_t projector);

  Backend backend_;
  std::vector<ProjectorPicture> pictures_;
  std::vector<std::optional<ProjectorWarp>> warps_;
  MasterLight light_;
  float shown_light_ = 1.0F;
  Buffer<float> master_;  //!< one from host memory, where a device reads it
  std::vector<Buffer<std::uint8_t>> rasters_;
};

}  // namespace ergodome
