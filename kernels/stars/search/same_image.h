#pragma once

#include <cmath>

#include "kernels/core/arithmetic.h"
#include "kernels/stars/seen_image.h"

// Recognizes images of stars that have been found twice.
namespace ergodome::inline ERGO_TARGET {

//! Returns whether two images of a star are the same image, found twice. `pixel`: angle of a pixel
//! [rad].
ERGO_HD bool are_one_image(const SeenImage& a, const SeenImage& b, double pixel) {
  // Images of one star that are nearer to each other than this and have the same parity are the
  // same.
  constexpr double same_image_px = 0.1;
  const Vector3<float> apart = a.image.direction - b.image.direction;
  const auto square = static_cast<double>(dot(apart, apart));
  const float ratio = a.image.magnification / b.image.magnification;
  const bool one_side = ratio > 0.0F;
  if (square < same_image_px * same_image_px * pixel * pixel && one_side) {
    return true;
  }
  // Arcs of one ring are equally bright; rings of different order lie side by side.
  const auto arc = static_cast<double>(maximum(a.arc, b.arc));
  return square < arc * arc && ::fabsf(::logf(::fabsf(ratio))) < 0.7F && (one_side || (a.capped && b.capped));
}

//! Orders a star's images independently of how they were found.
ERGO_HD bool comes_before(const StarImage& a, const StarImage& b) {
  const float of_a[4] = {a.direction.x, a.direction.y, a.direction.z, a.magnification};
  const float of_b[4] = {b.direction.x, b.direction.y, b.direction.z, b.magnification};
  int i = 0;
  while (i < 3 && of_a[i] == of_b[i]) {
    ++i;
  }
  return of_a[i] < of_b[i];
}

}  // namespace ergodome::inline ERGO_TARGET
