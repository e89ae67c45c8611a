#include "render/frame/shadow_mask.h"

#include <algorithm>
#include <cmath>

#include "kernels/core/dual.h"
#include "kernels/launch/parallel_for.h"
#include "kernels/launch/work_counter.h"
#include "kernels/projection/pixel_measure.h"
#include "kernels/projection/projection.h"
#include "kernels/shadow/pixel_coverage.h"

namespace ergodome {

namespace {

using PixelDual = Dual<float>;

Vector3<float> part(const Vector3<PixelDual>& v, float PixelDual::*which) {
  return {v.x.*which, v.y.*which, v.z.*which};
}

//! What is left of a pixel's light.
float light_left(const ProjectionOf<float>& projection, float x_px, float y_px, const EdgeCurve& head,
                 const EdgeCurve& eye) {
  const Vector3<PixelDual> view =
      direction_from_pixel(projection, PixelDual(x_px, 1.0F, 0.0F), PixelDual(y_px, 0.0F, 1.0F));
  const Vector3<float> n = part(view, &PixelDual::value);
  const Vector3<float> along_x = part(view, &PixelDual::along_x);
  const Vector3<float> along_y = part(view, &PixelDual::along_y);
  const float before = cover_pixel(head, n, along_x, along_y).lit;
  const float after = cover_pixel(eye, n, along_x, along_y).lit;
  return after < before ? after / before : 1.0F;
}

}  // namespace

void mask_shadow(Picture& picture, const Projection& projection, const EdgeCurve& head, const EdgeCurve& eye) {
  static WorkCounter counter("mask_shadow");
  const WorkScope work(counter, static_cast<long>(picture.width) * picture.height);
  const ProjectionOf<float> narrowed = converted_projection<float>(projection);
  const double reach = static_cast<double>(std::max(head.largest, eye.largest)) + 2.0 * largest_pixel_angle(projection);
  const float lowest = reach < 3.14159 ? static_cast<float>(std::cos(reach)) : -2.0F;
  parallel_for(picture.height, 8, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      float* pixel = picture.rgba.data() + 4 * static_cast<std::ptrdiff_t>(y) * picture.width;
      for (int x = 0; x < picture.width; ++x, pixel += 4) {
        const float x_px = static_cast<float>(x) + 0.5F;
        const float y_px = static_cast<float>(y) + 0.5F;
        const Vector3<float> n = direction_from_pixel(narrowed, x_px, y_px);
        if (dot(n, eye.centre) >= lowest) {
          const float left = light_left(narrowed, x_px, y_px, head, eye);
          for (int c = 0; c < 4; ++c) {
            pixel[c] *= left;
          }
        }
      }
    }
  });
}

}  // namespace ergodome
