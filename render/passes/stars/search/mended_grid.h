#pragma once

#include <vector>

#include "content/trajectory/lens_station.h"
#include "kernels/stars/search/mended_leaf.h"

namespace ergodome {

//! How far a leaf's patch is from the sky, as a part of the leaf's sides, by the rays of its checks.
struct LeafErrors {
  float told;  //!< at the most
  float left;  //!< when images are moved by what the rays say
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

  //! Moves an image of a star; see mend_image().
  bool mend(int leaf, const Vector3<double>& star, ChartImage& image) const;

  //! As kernels read it: put(vector) says where a copy of it lies for them, or where it is.
  template <class Put>
  [[nodiscard]] MendedLeaves view(const Put& put) const {
    return {put(boxes_), put(leaves_), put(nodes_), checks_.empty() ? nullptr : put(checks_)};
  }

 private:
  std::vector<float> boxes_;
  std::vector<int> leaves_;
  std::vector<float> nodes_;
  std::vector<float> checks_;
};

}  // namespace ergodome
