#include "render/passes/flat_shadow/shadow_mask.h"

#include <algorithm>
#include <cmath>

#include "kernels/core/dual.h"
#include "kernels/launch/parallel_for.h"
#include "kernels/launch/work_counter.h"
#include "kernels/projection/pixel_measure.h"
#include "kernels/projection/projection.h"
#include "kernels/spacetime/shadow/pixel_coverage.h"

namespace ergodome {

namespace {

using PixelDual = Dual<float>;

Vector3<float> part(const Vector3<PixelDual>& v, float PixelDual::*which) {
  return {v.x.*which, v.y.*which, v.z.*which};
}

//! Returns the fraction of a pixel's light that remains: what the eye's shadow does not cover,
//! relative to what the head's does not.
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

//! Side of the squares of pixels that are skipped as a whole if no edge can be in them [px].
constexpr int tile_px = 16;

//! Range of angles from the shadow's center within which pixels may contain one of the two edges.
struct EdgeRing {
  double inner;
  double outer;

  //! Returns whether a disk of `radius` around a direction overlaps the ring.
  [[nodiscard]] bool reaches(const Vector3<float>& direction, const Vector3<float>& middle, double radius) const {
    const double angle = std::acos(std::clamp(static_cast<double>(dot(direction, middle)), -1.0, 1.0));
    return angle - radius <= outer && angle + radius >= inner;
  }
};

//! A square of pixels; `right` and `bottom` are not part of it.
struct PixelSquare {
  int left, top, right, bottom;
};

void mask_square(Picture& picture, const ProjectionOf<float>& projection, const EdgeCurve& head, const EdgeCurve& eye,
                 const PixelSquare& square) {
  for (int y = square.top; y < square.bottom; ++y) {
    float* pixel = picture.rgba.data() + 4 * (static_cast<std::ptrdiff_t>(y) * picture.width + square.left);
    for (int x = square.left; x < square.right; ++x, pixel += 4) {
      const float left = light_left(projection, static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F, head, eye);
      for (int c = 0; c < 3; ++c) {
        pixel[c] *= left;
      }
      // The fourth channel is coverage, or opacity in front of the stars.
      pixel[3] = picture.stars ? 1.0F - left * (1.0F - pixel[3]) : left * pixel[3];
    }
  }
}

}  // namespace

void mask_shadow(Picture& picture, const Projection& projection, const EdgeCurve& head, const EdgeCurve& eye) {
  static WorkCounter counter("mask_shadow");
  const WorkScope work(counter, static_cast<long>(picture.width) * picture.height);
  const ProjectionOf<float> narrowed = converted_projection<float>(projection);
  const double pixel = largest_pixel_angle(projection);
  const EdgeRing ring = {static_cast<double>(head.smallest) - 2.0 * pixel,
                         static_cast<double>(std::max(head.largest, eye.largest)) + 2.0 * pixel};
  // Cube faces are tested pixel by pixel, because a square may extend across faces with different
  // directions.
  const int side_px = projection.kind == ProjectionKind::cube ? 1 : tile_px;
  const double radius = side_px * pixel;
  parallel_for((picture.height + side_px - 1) / side_px, std::max(8 / side_px, 1), [&](int begin, int end) {
    for (int top = begin * side_px; top < std::min(end * side_px, picture.height); top += side_px) {
      for (int left = 0; left < picture.width; left += side_px) {
        const float middle_px = 0.5F * static_cast<float>(side_px);
        const Vector3<float> n =
            direction_from_pixel(narrowed, static_cast<float>(left) + middle_px, static_cast<float>(top) + middle_px);
        if (ring.reaches(n, eye.centre, radius)) {
          mask_square(picture, narrowed, head, eye,
                      {left, top, std::min(left + side_px, picture.width), std::min(top + side_px, picture.height)});
        }
      }
    }
  });
}

}  // namespace ergodome
