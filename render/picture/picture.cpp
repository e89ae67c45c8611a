#include "render/picture/picture.h"

#include "kernels/launch/parallel_for.h"

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

void set_image_alpha(const Projection& projection, Picture& picture) {
  parallel_for(picture.height, 16, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      float* row = picture.rgba.data() + 4 * static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width);
      for (int x = 0; x < picture.width; ++x) {
        row[4 * static_cast<std::size_t>(x) + 3] = static_cast<float>(image_coverage(projection, x + 0.5, y + 0.5));
      }
    }
  });
}

}  // namespace ergodome
