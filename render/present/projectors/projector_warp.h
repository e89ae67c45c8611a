#pragma once

#include <cstdint>

#include "calibration/projectors/projector_picture.h"
#include "kernels/image/warp_pixels.h"
#include "render/present/projectors/master_light.h"

namespace ergodome {

//! What a projector shows of domemasters of one size, drawn by kernels: all that does not change from frame to frame is worked out
//! beforehand for each pixel, by the processor, and lies in the backend's memory. It shows what ProjectorDrawing does.
class ProjectorWarp {
 public:
  ProjectorWarp(const ProjectorPicture& picture, int master_width, int master_height, Backend backend);

  //! The master's parts that it looks at.
  [[nodiscard]] const LightTiles& tiles() const { return tiles_; }

  //! What warp_pixels() needs to fill a raster with the values that the projector is sent. Light, of which it shows a part as large as `shown`, and
  //! raster lie in the backend's memory.
  [[nodiscard]] WarpBatch batch(const LightLevels& light, float shown, std::uint8_t* rgb) const;

  //! Fills it: three bytes a pixel, the top row first. A device is not waited for.
  void draw(const LightLevels& light, float shown, std::uint8_t* rgb) const {
    warp_pixels(backend_, batch(light, shown, rgb));
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
