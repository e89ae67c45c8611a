#include "render/picture/image_alpha.h"

#include "kernels/launch/parallel_for.h"

namespace ergodome {

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
