#pragma once

#include "kernels/core/lanes.h"
#include "kernels/core/vector3.h"
#include "kernels/stars/search/star_bands.h"

namespace ergodome::inline ERGO_TARGET {

namespace detail {
//! Calls visit(first, last) for runs of adjacent stars that together are the stars of all cells
//! that a part of the sky touches.
template <class Visit>
ERGO_HD void visit_runs(const StarBands& stars, const SkyBounds& bounds, const Visit& visit) {
  const int first_cell = cell_among(bounds.turns, stars.cells);
  const int last_cell = static_cast<int>((bounds.turns + bounds.width_turns) * static_cast<float>(stars.cells));
  const int count = last_cell + 1 - first_cell;
  const int end_cell = first_cell + (count < stars.cells ? count : stars.cells);
  const int last_band = cell_among(0.5F * (bounds.high + 1.0F), stars.bands);
  for (int band = cell_among(0.5F * (bounds.low + 1.0F), stars.bands); band <= last_band; ++band) {
    const int* const first = stars.first + static_cast<long>(band) * stars.cells;
    if (end_cell <= stars.cells) {
      visit(first[first_cell], first[end_cell]);
    } else {
      visit(first[first_cell], first[stars.cells]);
      visit(first[0], first[end_cell - stars.cells]);
    }
  }
}

//! Returns the smallest level that contains all stars of at least this illuminance.
ERGO_HD const StarLevel& level_for(const SearchedField& field, float faintest) {
  int i = field.level_count - 1;
  while (i > 0 && !(field.levels[i].left_out < faintest)) {
    --i;
  }
  return field.levels[i];
}

//! Returns the lanes whose stars are at least as bright as `faintest` [lx] and lie in a part of the
//! sky. The arrays are padded for packs that read past their last element.
template <class T>
ERGO_HD MaskOf<T> is_within(const SkyPart& part, const StarBands& stars, int at, float faintest) {
  const auto load = [at](const float* from) { return load_lanes<T>(from, at, at + RealTraits<T>::lane_count); };
  const Vector3<T> direction = {load(stars.direction[0]), load(stars.direction[1]), load(stars.direction[2])};
  MaskOf<T> held = load(stars.illuminance) >= T(faintest);
  ERGO_UNROLL
  for (int i = 0; i < 4; ++i) {
    const float(&inward)[3] = part.inward[i];
    held = held & (inward[0] * direction.x + inward[1] * direction.y + inward[2] * direction.z >= T(0.0F));
  }
  return held;
}
}  // namespace detail

//! Calls found(number) for each star of a field that lies in a part of the sky and is above a
//! brightness threshold. `threads` threads share the work: of each run of adjacent stars, thread k
//! takes the packs k, k + threads, ...
template <class T, class Found>
ERGO_HD void search_field(const SearchedField& field, const SkyPart& part, const StarFloor& floor, int thread,
                          int threads, const Found& found) {
  constexpr int lanes = RealTraits<T>::lane_count;
  static_assert(lanes <= star_padding);
  if (field.level_count == 0) {
    return;
  }
  const float faintest = floor.illuminance / field.max_gain[floor.shift_row];
  const ShiftGain& gain = field.gains[floor.shift_row];
  const StarLevel& level = detail::level_for(field, faintest);
  detail::visit_runs(level.stars, part.bounds, [&](int first, int last) {
    for (int pack = first + lanes * thread; pack < last; pack += lanes * threads) {
      const MaskOf<T> held = detail::is_within<T>(part, level.stars, pack, faintest);
      for (unsigned bits = mask_bits(held) & bits_within<T>(pack, last); bits != 0; bits &= bits - 1) {
        const int at = pack + lowest_bit(bits);
        if (level.stars.illuminance[at] * gain.gain[level.colour[at]] >= floor.illuminance) {
          found(level.number[at]);
        }
      }
    }
  });
}

//! Lists the stars that are found. Runs once, with stars as lanes.
template <class T>
struct SearchStars {
  const StarSearchBatch& batch;

  ERGO_HD void operator()(int /*index*/) const {
    int count = 0;
    search_field<T>(*batch.field, batch.part, batch.floor, 0, 1, [&](int star) { batch.found[count++] = star; });
    *batch.count = count;
  }
};

template <class T, class Action>
void dispatch(const StarSearchBatch& batch, const Action& action) {
  action(SearchStars<T>{batch});
}

}  // namespace ergodome::inline ERGO_TARGET
