#pragma once

#include <cstdint>

#include "calibration/projectors/projector_picture.h"
#include "kernels/image/warp_pixels.h"
#include "render/present/projectors/master_light.h"

namespace ergodome {

//! Draws a projector's image of domemasters of one size with kernels. Everything that does not
//! change from frame to frame is computed beforehand on the CPU for each pixel and stored in the
//! backend's memory. Draws the same image as ProjectorDrawing.
class ProjectorWarp {
 public:
  ProjectorWarp(const ProjectorPicture& picture, int master_width, int master_height, Backend backend);

  //! Returns the tiles of the master's light that the projector's pixels read, on each mip level.
  [[nodiscard]] const LightTiles& tiles() const { return tiles_; }

  //! Returns the input with which warp_pixels() fills a raster with the projector's values. `light`
  //! and the raster `rgb` are in the backend's memory; `shown` is a factor on the light.
  [[nodiscard]] WarpBatch batch(const LightLevels& light, float shown, std::uint8_t* rgb) const;

  //! Fills a raster: three bytes per pixel, top row first. Does not wait for a GPU.
  void draw(const LightLevels& light, float shown, std::uint8_t* rgb) const {
    launch(backend_, batch(light, shown, rgb));
  }

 private:
  class Builder;
  void move_to(Backend backend);

  Backend backend_ = Backend::cpu;
  int width_px_;
  int height_px_;
  bool coloured_;
  float factor_scale_[3];
  float lift_scale_[3];
  float exponent_;
  LightTiles tiles_;
  Buffer<WarpGroup> groups_;
  Buffer<std::uint16_t> x_;
  Buffer<std::uint16_t> y_;
  Buffer<std::uint8_t> level_;
  Buffer<std::uint16_t> factor_;
};

}  // namespace ergodome
