#pragma once

#include <cmath>

#include "kernels/core/shared_counter.h"
#include "kernels/stars/observed_places_kernel.h"
#include "kernels/stars/search/patch_search.h"
#include "kernels/stars/search/search_rules.h"

// Keeps the roots that the search on the GPU finds.
namespace ergodome::inline ERGO_TARGET {

namespace detail {
template <class T>
ERGO_HD void append(const SharedList<T>& list, const T& value) {
  const int at = count_up(list.count);
  if (at < list.room) {
    list.at[at] = value;
  }
}

//! Rotates a star's direction to the frame of the patches, which belong to a camera at φ = 0, and
//! mirrors it if they cover the other half of a mirrored sky.
ERGO_HD Vector3<double> as_patches_see(const PatchSearchBatch& batch, const Vector3<double>& d, bool mirrored) {
  return {batch.cosine_phi * d.x + batch.sine_phi * d.y, batch.cosine_phi * d.y - batch.sine_phi * d.x,
          mirrored ? -d.z : d.z};
}
//! Computes how the observer sees an image that needs no rays. Keeps it if it is in view and bright
//! enough.
ERGO_HD void judge(const PatchSearchBatch& batch, int number, const FieldStar& star, const ChartImage& image) {
  Vector3<float> direction{};
  float area = 0.0F;
  float frequency_ratio = 0.0F;
  const ObservedPlaceBatch place = {batch.chart,
                                    batch.energy,
                                    batch.observer,
                                    1,
                                    &image.gamma_turns,
                                    &image.s,
                                    {&direction.x, &direction.y, &direction.z},
                                    &area,
                                    &frequency_ratio};
  ObservePlaces<float>{place}(0);
  const Vector3<double> way = {static_cast<double>(direction.x), static_cast<double>(direction.y),
                               static_cast<double>(direction.z)};
  SeenImage found{};
  if (cone_may_touch(batch.view_axis, batch.view_half_angle, batch.view_cosine, way, 0.0) &&
      exact_image(batch.colours, batch.look, number, star, direction, frequency_ratio, image.sky / area, found)) {
    append(batch.exact, found);
  }
}
}  // namespace detail

//! Keeps the image at a root of a pair's patch if it may be bright enough.
ERGO_HD void keep_root(const PatchSearchBatch& batch, const SearchedPair& pair, const FoldedRoot& root) {
  const StarPatch& patch = batch.patches[pair.patch];
  const FieldStar& star = batch.field.stars[pair.star];
  const float sky = sky_of_root(root.area, pair.depth);
  const ShiftGain& shift = batch.field.gains[patch.light.shift_row];
  const float gain = most_gain(patch, sky) * shift.gain[star_class(star.log_temperature)];
  if (!(star.illuminance * gain >= batch.faintest)) {
    return;
  }
  ChartImage image = chart_image(patch, root, sky);
  bool exact = false;
  if (patch.exact && patch.shape != PatchShape::folded) {
    const Vector3<double> d = detail::as_patches_see(batch, star.direction, pair.mirrored);
    exact = mend_image(batch.mended, patch.leaf,
                       {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)}, image);
  }
  const float seen = pair.mirrored ? 1.0F - image.gamma_turns : image.gamma_turns;
  image.gamma_turns = seen - ::floorf(seen);
  if (exact && batch.judges) {
    detail::judge(batch, pair.star, star, image);
  } else {
    detail::append(batch.images,
                   {pair.star, image.gamma_turns, image.s, image.sky, patch.brighter, exact, root.area == 0.0F});
  }
}

}  // namespace ergodome::inline ERGO_TARGET
