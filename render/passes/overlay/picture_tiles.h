#pragma once

#include <cstdint>
#include <vector>

#include "kernels/overlay/draw_overlay.h"

namespace ergodome {

//! The squares of overlay_tile_px that a picture is divided into, each with a cone that holds its directions: where an overlay may be is found without
//! asking every pixel.
class PictureTiles {
 public:
  explicit PictureTiles(const Projection& projection);

  //! Whether it is the picture's of that projection.
  [[nodiscard]] bool are_of(const Projection& projection) const;

  //! Numbers of the tiles that may see any of a sheet's bound.
  [[nodiscard]] std::vector<std::int32_t> within(const OverlaySheet& sheet) const;

  [[nodiscard]] int columns() const { return columns_; }

 private:
  struct Cone {
    Vector3<float> axis;
    float half_angle;  //!< [rad]; above π: everywhere
  };

  Cone cone_of(int column, int row) const;

  Projection projection_;
  int columns_;
  int rows_;
  std::vector<Cone> cones_;
};

}  // namespace ergodome
