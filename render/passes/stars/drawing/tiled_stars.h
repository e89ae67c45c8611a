#pragma once

#include <vector>

#include "kernels/stars/draw_stars.h"
#include "render/backend/buffer.h"
#include "render/passes/effects/diffraction.h"
#include "render/passes/stars/drawing/point_placer.h"
#include "render/passes/stars/drawing/star_splat.h"

namespace ergodome {

//! Draws stars on a picture in a backend's memory. Each pixel adds up the points near it: the
//! equivalent of splat_points() and add_diffraction() for GPUs. Reuses its memory from picture to
//! picture.
class TiledStars {
 public:
  explicit TiledStars(Backend backend) : backend_(backend) {}

  //! Sets the points to draw. `splat` must be scaled to the projection (scaled_to). `pattern` of
  //! the spikes may be nullptr.
  void set(const std::vector<StarPoint>& points, const Projection& projection, const SplatSettings& splat,
           const DiffractionPattern* pattern);

  //! Sets points that are already in the backend's memory and must stay valid until they are drawn.
  void set(const PlacedPoints& points, const Projection& projection, const SplatSettings& splat,
           const DiffractionPattern* pattern);

  //! Adds the light to rows of the picture.
  void draw(int first_row, int row_count, float* rgba) const;

 private:
  //! Points grouped by the picture tiles that their light reaches.
  struct Placed {
    long members = 0;
    Buffer<std::int32_t> counts;
    Buffer<std::int32_t> first;
    Buffer<std::int32_t> numbers;
  };

  void place(double reach_px, bool spikes_alone, Placed& placed) const;
  void set_pattern(const DiffractionPattern& pattern);
  [[nodiscard]] int columns() const { return (projection_.width_px + star_tile_px - 1) / star_tile_px; }
  [[nodiscard]] StarLightBatch batch_of(const Placed& placed) const;

  Backend backend_;
  Projection projection_{};
  SplatSettings splat_;
  PlacedPoints points_;
  Buffer<StarPoint> own_points_;  //!< copy of points from host memory
  Placed spots_;
  Placed spikes_;
  Buffer<float> pattern_;
  std::vector<float> pattern_there_;  //!< the pattern that the buffer `pattern_` currently contains
  int pattern_px_ = 0;
};

}  // namespace ergodome
