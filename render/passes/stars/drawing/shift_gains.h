#pragma once

#include <vector>

#include "kernels/sky/blackbody.h"
#include "kernels/stars/field_star.h"

namespace ergodome {

//! Upper bounds of the luminance gain of stars seen with a frequency ratio. Tabulated without
//! exponentials and logarithms at lookup, because the image search reads them for each patch.
class ShiftGains {
 public:
  //! `colours` is in host memory.
  explicit ShiftGains(const BlackbodyTable& colours);

  //! Returns the lowest row that bounds the gain for `frequency_ratio` and below.
  [[nodiscard]] static int row_of(float frequency_ratio);

  //! Returns the row for unshifted light, with gain 1.
  static int unshifted_row();

  //! Returns the upper bounds of the gain for each class.
  [[nodiscard]] const ShiftGain& row(int number) const { return rows_[static_cast<std::size_t>(number)]; }

  [[nodiscard]] const std::vector<ShiftGain>& rows() const { return rows_; }

 private:
  std::vector<ShiftGain> rows_;
};

}  // namespace ergodome
