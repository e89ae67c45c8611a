#pragma once

#include <utility>
#include <vector>

#include "content/trajectory/lens_station.h"
#include "kernels/stars/search/corrected_leaf.h"

namespace ergodome {

//! Function to pass to view() as `put` if kernels run on the CPU: returns the address of the
//! vector's own data.
inline constexpr auto host_data = [](const auto& values) { return values.data(); };

//! Errors of a leaf's interpolating patch at the rays that checked the leaf, as fractions of the
//! leaf's sides.
struct LeafErrors {
  float displaced;  //!< largest displacement of a direction in the chart
  float left;       //!< largest displacement that remains after the correction
};

//! A lens grid corrected by its check rays: star images found with cubic patches are moved to the
//! positions that rays give.
//!
//! The leading error of a cubic that is exact at its ends is a quartic, proportional to (t (1 -
//! t))² at fraction t along a side. The checks at the midpoints of a leaf's four sides each measure
//! such a displacement δ, which is interpolated across the leaf. The corrected sky is the patch at
//! x - δ(x), and its Jacobian is that of the patch times that of x - δ. The error that remains at
//! the inner checks, mostly of fifth order, measures the quality.
class CorrectedGrid {
 public:
  //! The station must have been built with GridSettings::inverted; otherwise its errors are
  //! unknown.
  explicit CorrectedGrid(const LensStation& station);

  //! The grid of a camera beside that of `other`, whose rays give `nodes`. The displacements at the
  //! checks, in fractions of a leaf, hardly differ.
  CorrectedGrid(const CorrectedGrid& other, std::vector<float> nodes) : CorrectedGrid(other) {
    nodes_ = std::move(nodes);
  }

  //! Returns the errors of a leaf. Unknown errors are huge, so that no star image in it counts as
  //! exact, and rays refine them all.
  [[nodiscard]] LeafErrors errors(int leaf) const;

  //! Returns the grid for kernels. put(vector) returns the address at which kernels read the
  //! vector: that of a copy, or of its own data.
  template <class Put>
  [[nodiscard]] CorrectedLeaves view(const Put& put) const {
    return {put(boxes_), put(leaves_), put(nodes_), checks_.empty() ? nullptr : put(checks_)};
  }

 private:
  std::vector<float> boxes_;
  std::vector<int> leaves_;
  std::vector<float> nodes_;
  std::vector<float> checks_;
};

}  // namespace ergodome
