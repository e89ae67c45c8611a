#pragma once

#include "kernels/image/shade_pixels.h"

// Ranges of values that heat maps show as colors.

namespace ergodome {

//! Ends of a heat map's color bar, in the units that are displayed.
struct ViewRange {
  double low;
  double high;
};

//! Ends of a heat map's color bar, in the units that are displayed, and whether it is logarithmic.
struct HeatRange {
  double low;
  double high;
  bool logarithmic;
};

//! Returns the range of a heat map's color bar. It is logarithmic for steps of methods that differ
//! by orders of magnitude.
HeatRange heat_range(ViewMode mode, bool logarithmic_steps = false);

}  // namespace ergodome
