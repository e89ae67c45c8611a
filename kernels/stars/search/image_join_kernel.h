#pragma once

#include <cmath>

#include "kernels/core/arithmetic.h"
#include "kernels/core/shared_counter.h"
#include "kernels/core/sort_in_place.h"
#include "kernels/stars/search/image_join.h"

// Kernels that collect the images of each star and drop those found twice.
namespace ergodome::inline ERGO_TARGET {

namespace detail {
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
  // Overlapping arcs with similar magnifications are parts of one ring, and count as one image. A
  // ring of another order beside it has a very different magnification.
  const auto arc = static_cast<double>(maximum(a.arc, b.arc));
  return square < arc * arc && ::fabsf(::logf(::fabsf(ratio))) < 0.7F && (one_side || (a.capped && b.capped));
}

//! Orders a star's images by direction, then by magnification, independently of the order in which
//! they were found.
ERGO_HD bool comes_before(const StarImage& a, const StarImage& b) {
  const float of_a[4] = {a.direction.x, a.direction.y, a.direction.z, a.magnification};
  const float of_b[4] = {b.direction.x, b.direction.y, b.direction.z, b.magnification};
  int i = 0;
  while (i < 3 && of_a[i] == of_b[i]) {
    ++i;
  }
  return of_a[i] < of_b[i];
}

ERGO_HD const SeenImage& found_image(const ImageJoinBatch& batch, int number) {
  return number < batch.found_count[0] ? batch.found[0][number] : batch.found[1][number - batch.found_count[0]];
}
}  // namespace detail

//! Counts an image for its star or, if `Numbers`, stores the image's number in the star's list.
template <bool Numbers>
struct CountImage {
  ImageJoinBatch batch;

  ERGO_HD void operator()(int index) const {
    const int star = detail::found_image(batch, index).image.star;
    if (star < 0) {
      return;
    }
    const std::int32_t before = count_up(batch.counts + star);
    if constexpr (Numbers) {
      batch.numbers[batch.first[star] + before] = index;
    }
  }
};

//! Takes the images of a star in sorted order, because threads number them in nondeterministic
//! order. Marks all but the first of equal images as duplicates.
struct TakeImages {
  ImageJoinBatch batch;

  ERGO_HD void operator()(int star) const {
    const std::int32_t first = batch.first[star];
    const int count = batch.first[star + 1] - first;
    std::int32_t* const numbers = batch.numbers + first;
    sort_in_place(numbers, count, [&](std::int32_t a, std::int32_t b) {
      return batch.order == ImageOrder::as_found
                 ? a < b
                 : detail::comes_before(detail::found_image(batch, a).image, detail::found_image(batch, b).image);
    });
    for (int i = 0; i < count; ++i) {
      const SeenImage& here = detail::found_image(batch, numbers[i]);
      StarImage& image = batch.images[first + i];
      image = here.image;
      for (int j = 0; j < i; ++j) {
        if (batch.images[first + j].star >= 0 &&
            detail::are_one_image(here, detail::found_image(batch, numbers[j]), batch.pixel)) {
          image.star = -1;
        }
      }
    }
  }
};

template <class T, class Action>
void dispatch(const ImageJoinBatch& batch, const Action& action) {
  switch (batch.step) {
    case ImageJoinStep::count:
      return action(CountImage<false>{batch});
    case ImageJoinStep::number:
      return action(CountImage<true>{batch});
    case ImageJoinStep::take:
      break;
  }
  action(TakeImages{batch});
}

}  // namespace ergodome::inline ERGO_TARGET
