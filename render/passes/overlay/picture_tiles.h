#pragma once

#include <cstdint>
#include <vector>

#include "kernels/overlay/draw_overlay.h"

namespace ergodome {

//! The square tiles of side overlay_tile_px into which a picture is divided, each with a cone that
//! contains the tile's directions. Used to find the pixels of an overlay without testing all of
//! them.
class PictureTiles {
 public:
  explicit PictureTiles(const Projection& projection);

  //! Returns whether the tiles were computed for this projection.
  [[nodiscard]] bool are_of(const Projection& projection) const;

  //! Returns the indices of the tiles that may overlap an overlay's bounding cone.
  [[nodiscard]] std::vector<std::int32_t> within(const OverlaySurface& surface) const;

  [[nodiscard]] int columns() const { return columns_; }

 private:
  struct Cone {
    Vector3<float> axis;
    //! Half angle of the cone [rad]; above π: the tile may contain all directions.
    float half_angle;
  };

  Cone cone_of(int column, int row) const;

  Projection projection_;
  int columns_;
  int rows_;
  std::vector<Cone> cones_;
};

}  // namespace ergodome
