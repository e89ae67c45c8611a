#pragma once

#include <vector>

#include "kernels/sky/blackbody.h"
#include "kernels/stars/field_star.h"

namespace ergodome {

//! Bounds of what stars gain in luminance when their light is seen with some frequency ratio, with neither exponentials nor logarithms:
//! the search for images asks them of each patch.
class ShiftGains {
 public:
  //! `colours`: in host memory.
  explicit ShiftGains(const BlackbodyTable& colours);

  //! The least row whose stars gain at least what they do at `frequency_ratio` or below.
  [[nodiscard]] static int row_of(float frequency_ratio);

  //! The row of light that is not shifted: nothing gains.
  static int unshifted_row();

  //! What no star of a class gains more than.
  [[nodiscard]] const ShiftGain& row(int number) const { return rows_[static_cast<std::size_t>(number)]; }

  [[nodiscard]] const std::vector<ShiftGain>& rows() const { return rows_; }

 private:
  std::vector<ShiftGain> rows_;
};

}  // namespace ergodome
