#pragma once

#include "kernels/core/shared_counter.h"
#include "kernels/core/sort_in_place.h"
#include "kernels/stars/search/same_image.h"
#include "kernels/stars/search/star_twins.h"

// Kernels that collect the images of each star and drop those found twice.
namespace ergodome::inline ERGO_TARGET {

namespace detail {
ERGO_HD const SeenImage& found_image(const StarTwinBatch& batch, int number) {
  return number < batch.found_count[0] ? batch.found[0][number] : batch.found[1][number - batch.found_count[0]];
}
}  // namespace detail

//! Counts an image for its star, or lists its number there.
template <bool Numbers>
struct CountImage {
  StarTwinBatch batch;

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

//! Takes the images of a star, sorted by position since they are numbered in nondeterministic
//! order. Marks all but the first of equal images as duplicates.
struct TakeImages {
  StarTwinBatch batch;

  ERGO_HD void operator()(int star) const {
    const std::int32_t first = batch.first[star];
    const int count = batch.first[star + 1] - first;
    std::int32_t* const numbers = batch.numbers + first;
    sort_in_place(numbers, count, [&](std::int32_t a, std::int32_t b) {
      return comes_before(detail::found_image(batch, a).image, detail::found_image(batch, b).image);
    });
    for (int i = 0; i < count; ++i) {
      const SeenImage& here = detail::found_image(batch, numbers[i]);
      StarImage& image = batch.images[first + i];
      image = here.image;
      for (int j = 0; j < i; ++j) {
        if (batch.images[first + j].star >= 0 &&
            are_one_image(here, detail::found_image(batch, numbers[j]), batch.pixel)) {
          image.star = -1;
        }
      }
    }
  }
};

template <class T, class Action>
void dispatch(const StarTwinBatch& batch, const Action& action) {
  switch (batch.step) {
    case StarTwinStep::count:
      return action(CountImage<false>{batch});
    case StarTwinStep::number:
      return action(CountImage<true>{batch});
    case StarTwinStep::take:
      break;
  }
  action(TakeImages{batch});
}

}  // namespace ergodome::inline ERGO_TARGET
