#pragma once

#include <cstdint>
#include <vector>

#include "calibration/projector_picture.h"
#include "kernels/image/warp_pixels.h"
#include "render/present/master_light.h"

namespace ergodome {

//! What a projector shows of domemasters of one size, drawn by the processor: all that does not change from frame to frame is worked out
//! beforehand for each pixel. It shows what ProjectorDrawing does.
class ProjectorWarp {
 public:
  ProjectorWarp(const ProjectorPicture& picture, int master_width, int master_height);

  //! The master's parts that it looks at.
  [[nodiscard]] const LightTiles& tiles() const { return tiles_; }

  //! Fills a raster with the values that the projector is sent: three bytes a pixel, the top row first.
  void draw(const LightLevels& light, std::uint8_t* rgb) const;

 private:
  class Builder;
  int width_px_;
  int height_px_;
  bool coloured_;
  float factor_scale_[3];
  float lift_scale_[3];
  float exponent_;
  LightTiles tiles_;
  std::vector<WarpGroup> groups_;
  std::vector<std::uint16_t> x_;
  std::vector<std::uint16_t> y_;
  std::vector<std::uint8_t> level_;
  std::vector<std::uint16_t> factor_;
};

}  // namespace ergodome
