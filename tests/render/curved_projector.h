#pragma once

#include <cmath>

#include "calibration/projectors/projector_picture.h"

// Pictures of projectors that use every feature of a projector picture.
namespace ergodome::test {

//! Returns the test light at a position (u, v) of the master. It varies smoothly, and is brighter
//! than white in one corner.
inline Vector3<float> soft_colours(double u, double v) {
  return {static_cast<float>(0.4 + 0.3 * std::sin(5.0 * u)), static_cast<float>(0.5 + 0.4 * std::cos(6.0 * v)),
          static_cast<float>(0.1 + 2.0 * u * v)};
}

//! Returns the picture of a projector with a curved warp over most of its small raster, with
//! intensities, a hole, colored masks and all other features.
inline ProjectorPicture curved_picture() {
  ProjectorPicture picture;
  picture.name = "curved";
  picture.width_px = 90;
  picture.height_px = 60;
  picture.warp.columns = 9;
  picture.warp.rows = 7;
  for (int row = 0; row < 7; ++row) {
    for (int column = 0; column < 9; ++column) {
      const auto x = static_cast<float>(column / 8.0);
      const auto y = static_cast<float>(row / 6.0);
      const bool hole = row == 2 && column == 6;
      picture.warp.nodes.push_back({x * 1.1F - 0.03F, y * 0.95F + 0.04F * x, 0.2F + 0.5F * x + 0.1F * y * y,
                                    0.8F - 0.5F * y + 0.1F * x * y, 0.6F + 0.4F * x, !hole});
    }
  }
  picture.blend = {5, 4, 3, 16, {}};
  for (int i = 0; i < 60; ++i) {
    picture.blend.values.push_back(0.4F + 0.01F * static_cast<float>(i));
  }
  picture.black_level = {2, 2, 1, 8, {0.2F, 1.0F, 0.6F, 0.9F}};
  picture.black_level_lift = {0.02, 0.05, 0.01};
  picture.gain = {1.0, 0.9, 1.3};
  picture.gamma = 1.9;
  return picture;
}

//! Returns the curved projector with gray masks, which have a single factor per pixel.
inline ProjectorPicture grey_picture() {
  ProjectorPicture picture = curved_picture();
  picture.width_px = 93;  // not a multiple of the number of pixels drawn at a time
  picture.black_level = {};
  picture.blend = {3, 2, 1, 16, {0.0F, 0.5F, 1.0F, 0.3F, 0.6F, 0.9F}};
  return picture;
}

//! Returns the gray projector without masks, with moved corners and the opposite curvature of the
//! warp.
inline ProjectorPicture plain_picture() {
  ProjectorPicture picture = grey_picture();
  picture.blend = {};
  picture.gamma = 0.8;
  picture.offsets.right = {0.05, -0.1, 0.0, 0.02};
  picture.offsets.down = {0.0, 0.03, 0.1, -0.04};
  return picture;
}

}  // namespace ergodome::test
