#pragma once

#include <array>
#include <vector>

#include "kernels/sky/blackbody.h"

namespace ergodome {

//! Classes of stars by their temperature, equally wide in its logarithm.
inline constexpr int star_classes = 16;

//! The class of a star; `log_temperature`: ln T [K].
int star_class(float log_temperature);

//! What stars gain in luminance by a shift of their light, by their class.
struct ShiftGain {
  std::array<float, star_classes> gain;
  std::array<float, star_classes> log_gain;
};

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

 private:
  std::vector<ShiftGain> rows_;
};

}  // namespace ergodome
