#pragma once

#include <vector>

#include "content/lens_station.h"
#include "kernels/lens/grid_build.h"

namespace ergodome {

//! How far a leaf's patch is from the sky, as a part of the leaf's sides, by the rays of its checks.
struct LeafErrors {
  float told;  //!< at the most
  float left;  //!< when images are moved by what the rays say
};

//! An image of a star in a lens chart.
struct ChartImage {
  float gamma_turns;
  float s;
  float sky;  //!< solid angle of the stars' sky per area of the chart; negative where turned over [sr/turn]
};

//! A lens grid with what its checks found: images that cubic patches have are moved to where the rays have them.
//!
//! A cubic between exact ends misses by a quartic first, (t (1 - t))² of the way t along a side. Through the middles of a leaf's four sides
//! there is one such displacement δ, blended across: the sky is the patch at x - δ(x), its Jacobian the patch's times that of x - δ. What δ
//! leaves at the checks inside, most of it of the fifth order, tells how good that is.
class MendedGrid {
 public:
  //! Of a station that was built to be inverted (GridSettings); errors of others are not known.
  explicit MendedGrid(const LensStation& station);

  //! Errors that are not known are huge: such leaves cannot mend anything.
  [[nodiscard]] LeafErrors errors(int leaf) const;

  //! Moves an image of the star at the unit vector `star` from where a leaf's patch has it, about, to where its rays have it. False where it
  //! is farther off than first order reaches; then nothing is changed.
  bool mend(int leaf, const Vector3<double>& star, ChartImage& image) const;

 private:
  //! In parts of a leaf's sides.
  struct Displacement {
    float along_gamma;
    float along_s;
    float spread;  //!< its divergence
  };

  [[nodiscard]] Displacement displacement(int leaf, float u, float v) const;

  std::vector<LeafBox> boxes_;
  std::vector<int> leaves_;
  std::vector<float> nodes_;
  std::vector<float> checks_;
};

}  // namespace ergodome
