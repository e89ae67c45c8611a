#include "render/passes/flat_shadow/shadow_mask.h"

#include <algorithm>
#include <cmath>

#include "kernels/core/angles.h"
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

//! Effect of the two edges on the light of a square of pixels.
enum class Masking { none, dark, partial };

//! The region between the edges of the head's and the eye's shadow, which loses its light.
class Crescent {
 public:
  //! `pixel`: largest angle of a pixel [rad]. The edges must outlive this object.
  Crescent(const EdgeCurve& head, const EdgeCurve& eye, double pixel)
      : head_(head),
        eye_(eye),
        pixel_(pixel),
        inner_(static_cast<double>(head.smallest) - 2.0 * pixel),
        outer_(static_cast<double>(std::max(head.largest, eye.largest)) + 2.0 * pixel) {}

  //! Returns what happens to pixels whose directions are within `radius` [rad] of a direction:
  //! `none` and `dark` only if it is certain for all of them.
  [[nodiscard]] Masking masking(const Vector3<float>& direction, double radius) const {
    const auto along = [&](const Vector3<float>& axis) { return static_cast<double>(dot(direction, axis)); };
    const double x = along(head_.first);
    const double y = along(head_.second);
    const double alpha = std::atan2(std::hypot(x, y), along(head_.centre));
    const double near = alpha - radius;
    const double far = alpha + radius;
    if (near > outer_ || far < inner_) {
      return Masking::none;
    }
    // Position angles have no range around the chart's center, and shadows smaller than a pixel have
    // no edge (cover_pixel()).
    const double across = std::sin(radius) / std::sin(alpha);
    if (!(near > 0.0 && far < 0.5 * full_turn && across < 1.0 && static_cast<double>(head_.largest) > 2.0 * pixel_)) {
      return Masking::partial;
    }
    const Range range = range_of(std::atan2(y, x), std::asin(across));
    if (range.equal) {
      return Masking::none;
    }
    // A pixel is partly lit within half a pixel of the edge, measured across the edge, which may be
    // inclined. Between its points, the edge is at most `step` outside their range.
    const double slope = range.step * steps_per_radian() / std::min(std::sin(near), std::sin(far));
    const double margin = 2.0 * pixel_ * (1.0 + slope) + range.step;
    if (near > range.eye_largest + margin || far < range.head_smallest - margin) {
      return Masking::none;
    }
    return near > range.head_largest + margin && far < range.eye_smallest - margin ? Masking::dark : Masking::partial;
  }

 private:
  //! The points of both edges in a range of position angles.
  struct Range {
    bool equal = true;  //!< the edges coincide
    double head_smallest = INFINITY;
    double head_largest = 0.0;
    double eye_smallest = INFINITY;
    double eye_largest = 0.0;
    double step = 0.0;  //!< largest difference between neighboring points [rad]
  };

  [[nodiscard]] double steps_per_radian() const { return head_.count / full_turn; }

  //! Returns the range of the points that edge_at() uses within `half` [rad] of a position angle.
  [[nodiscard]] Range range_of(double gamma, double half) const {
    const int count = head_.count;
    const int first = static_cast<int>(std::floor((gamma - half) * steps_per_radian())) - 2;
    const int last = std::min(static_cast<int>(std::ceil((gamma + half) * steps_per_radian())) + 3, first + count);
    Range range;
    int before = ((first - 1) % count + count) % count;
    for (int i = first; i <= last; ++i) {
      const int at = before + 1 < count ? before + 1 : 0;
      const auto of_head = static_cast<double>(head_.polar_angle[at]);
      const auto of_eye = static_cast<double>(eye_.polar_angle[at]);
      range.equal = range.equal && of_head == of_eye;
      range.head_smallest = std::min(range.head_smallest, of_head);
      range.head_largest = std::max(range.head_largest, of_head);
      range.eye_smallest = std::min(range.eye_smallest, of_eye);
      range.eye_largest = std::max(range.eye_largest, of_eye);
      range.step = std::max({range.step, std::abs(of_head - static_cast<double>(head_.polar_angle[before])),
                             std::abs(of_eye - static_cast<double>(eye_.polar_angle[before]))});
      before = at;
    }
    return range;
  }

  const EdgeCurve& head_;
  const EdgeCurve& eye_;
  double pixel_;
  double inner_;  //!< range of angles from the shadow's center in which the edges are [rad]
  double outer_;
};

//! A square of pixels, which may extend past the right and the bottom of the picture.
struct PixelSquare {
  int left, top, side;
};

//! Side of the squares at which the search for the crescent starts, and of those whose pixels are
//! masked one by one [px].
constexpr int largest_side = 16;
constexpr int smallest_side = 4;

//! Masks a picture, square by square.
class ShadowMask {
 public:
  ShadowMask(Picture& picture, const Projection& projection, const EdgeCurve& head, const EdgeCurve& eye)
      : picture_(picture),
        projection_(converted_projection<float>(projection)),
        head_(head),
        eye_(eye),
        pixel_(largest_pixel_angle(projection)),
        crescent_(head, eye, pixel_) {}

  void mask(const PixelSquare& square) {
    if (square.left >= picture_.width || square.top >= picture_.height) {
      return;
    }
    const float half = 0.5F * static_cast<float>(square.side);
    const Vector3<float> middle = direction_from_pixel(projection_, static_cast<float>(square.left) + half,
                                                       static_cast<float>(square.top) + half);
    const Masking masking = crescent_.masking(middle, square.side * pixel_);
    if (masking == Masking::partial && square.side > smallest_side) {
      const int side = square.side / 2;
      for (int quarter = 0; quarter < 4; ++quarter) {
        mask({square.left + quarter % 2 * side, square.top + quarter / 2 * side, side});
      }
    } else if (masking != Masking::none) {
      mask_pixels(square, masking == Masking::dark);
    }
  }

 private:
  void mask_pixels(const PixelSquare& square, bool dark) {
    for (int y = square.top; y < std::min(square.top + square.side, picture_.height); ++y) {
      float* pixel = picture_.rgba.data() + 4 * (static_cast<std::ptrdiff_t>(y) * picture_.width + square.left);
      for (int x = square.left; x < std::min(square.left + square.side, picture_.width); ++x, pixel += 4) {
        const float left =
            dark ? 0.0F
                 : light_left(projection_, static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F, head_, eye_);
        for (int c = 0; c < 3; ++c) {
          pixel[c] *= left;
        }
        // The fourth channel is coverage, or opacity in front of the stars.
        pixel[3] = picture_.stars ? 1.0F - left * (1.0F - pixel[3]) : left * pixel[3];
      }
    }
  }

  Picture& picture_;
  ProjectionOf<float> projection_;
  const EdgeCurve& head_;
  const EdgeCurve& eye_;
  double pixel_;  //!< largest angle of a pixel [rad]
  Crescent crescent_;
};

}  // namespace

void mask_shadow(Picture& picture, const Projection& projection, const EdgeCurve& head, const EdgeCurve& eye) {
  static WorkCounter counter("mask_shadow");
  const WorkScope work(counter, static_cast<long>(picture.width) * picture.height);
  ShadowMask mask(picture, projection, head, eye);
  // Cube faces are tested pixel by pixel, because a square may extend across faces with different
  // directions.
  const int side = projection.kind == ProjectionKind::cube ? 1 : largest_side;
  parallel_for((picture.height + side - 1) / side, std::max(8 / side, 1), [&](int begin, int end) {
    for (int row = begin; row < end; ++row) {
      for (int left = 0; left < picture.width; left += side) {
        mask.mask({left, row * side, side});
      }
    }
  });
}

}  // namespace ergodome
