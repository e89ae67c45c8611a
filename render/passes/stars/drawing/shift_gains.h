#pragma once

#include <vector>

#include "kernels/sky/blackbody.h"
#include "kernels/stars/field_star.h"

namespace ergodome {

//! Upper bounds of the factor by which a frequency shift changes the luminance of stars, by class
//! of star color and by frequency ratio. They are tabulated, so that look-ups need no exponentials
//! and logarithms: the image search reads them for each patch.
class ShiftGains {
 public:
  //! `colours` is in host memory.
  explicit ShiftGains(const BlackbodyTable& colours);

  //! Returns the lowest row whose bounds hold for `frequency_ratio` and all lower ratios.
  [[nodiscard]] static int row_of(float frequency_ratio);

  //! Returns the row for unshifted light, with gain 1.
  static int unshifted_row();

  //! Returns the upper bounds in a row, one for each class of star color.
  [[nodiscard]] const ShiftGain& row(int number) const { return rows_[static_cast<std::size_t>(number)]; }

  [[nodiscard]] const std::vector<ShiftGain>& rows() const { return rows_; }

 private:
  std::vector<ShiftGain> rows_;
};

}  // namespace ergodome
