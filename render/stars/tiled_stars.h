#pragma once

#include <optional>
#include <span>
#include <vector>

#include "kernels/stars/draw_stars.h"
#include "render/backend/buffer.h"
#include "render/effects/diffraction.h"
#include "render/stars/star_splat.h"

namespace ergodome {

//! Which points' light may reach which squares of a picture.
struct StarTiles {
  std::vector<std::int32_t> tiles;  //!< those that light may reach, as StarLightBatch has them
  std::vector<std::int32_t> first;
  std::vector<std::int32_t> members;
  int columns = 0;
};

//! `chosen`: numbers of points; their light reaches `reach_px` from their places along x and along y.
StarTiles star_tiles(std::span<const StarPoint> points, std::span<const std::int32_t> chosen,
                     const Projection& projection, double reach_px);

//! Draws stars on a picture that is in a backend's memory, and leaves it there: splat_points() and spikes, made by the pixels. Keeps its
//! memory from picture to picture.
class TiledStars {
 public:
  explicit TiledStars(Backend backend) : backend_(backend) {}

  //! What is drawn from now on; `splat` is scaled to the projection (scaled_to). `pattern`, of the spikes, may be nullptr.
  void set(const std::vector<StarPoint>& points, const Projection& projection, const SplatSettings& splat,
           const DiffractionPattern* pattern);

  //! Adds the light to rows of the picture.
  void draw(int first_row, int row_count, float* rgba) const;

 private:
  //! Tiles where the kernel finds them.
  struct Placed {
    int tiles = 0;
    int points = 0;
    int columns = 0;
    Buffer<std::int32_t> numbers;  //!< of tiles, then where their points begin, then the points
  };

  void place(const StarTiles& tiles, std::size_t points, Placed& placed) const;
  [[nodiscard]] StarLightBatch batch_of(const Placed& placed) const;

  Backend backend_;
  Projection projection_{};
  SplatSettings splat_;
  Buffer<StarPoint> points_;
  Placed spots_;
  Placed spikes_;
  Buffer<float> pattern_;
  std::vector<float> pattern_there_;  //!< what `pattern_` holds
  int pattern_px_ = 0;
};

}  // namespace ergodome
