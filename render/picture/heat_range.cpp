#include "render/picture/heat_range.h"

namespace ergodome {

HeatRange heat_range(ViewMode mode, bool logarithmic_steps) {
  switch (mode) {
    case ViewMode::steps:
      return logarithmic_steps ? HeatRange{1.0, 1e3, true} : HeatRange{0.0, 16.0, false};
    case ViewMode::error_estimate:
      return {1e-7, 1e-2, true};
    case ViewMode::image_order:
      return {0.0, 3.0, false};
    case ViewMode::frequency_ratio:
      return {0.25, 4.0, true};
    default:
      return {1e-3, 1e3, true};
  }
}

}  // namespace ergodome
