#include "render/stars/rough_images.h"

#include <algorithm>
#include <cmath>

#include "kernels/launch/launch.h"
#include "kernels/stars/search_rules.h"

namespace ergodome {

void RoughImageFinder::PairList::add(const Pair& pair, float at_a, float at_b) {
  pairs.push_back(pair);
  patch.push_back(&pair.patch->sky);
  a.push_back(at_a);
  b.push_back(at_b);
}

void RoughImageFinder::PairList::clear() {
  pairs.clear();
  patch.clear();
  a.clear();
  b.clear();
}

PatchPairBatch RoughImageFinder::PairList::batch() const {
  return {static_cast<int>(pairs.size()), patch.data(), a.data(), b.data()};
}

RoughImageFinder::RoughImageFinder(const StarPatches& patches, const StarField& field, double phi)
    : patches_(patches), field_(field), turn_(sky_turn(phi)), sine_phi_(std::sin(phi)), cosine_phi_(std::cos(phi)) {}

void RoughImageFinder::look_in(const StarPatch& patch, bool mirrored) {
  const int count = field_.search(turned(patch.part, turn_, mirrored), patches_.floor_of(patch), stars_);
  const PatchFrame& frame = patch.frame;
  PairList& list = patch.shape == PatchShape::regular ? regular_ : patch.shape == PatchShape::bent ? bent_ : folded_;
  for (int i = 0; i < count; ++i) {
    const int star = stars_[static_cast<std::size_t>(i)];
    const Vector3<double> d = as_patches_see(field_.stars()[static_cast<std::size_t>(star)], mirrored);
    const double depth = dot(d, frame.axis);
    list.add({&patch, mirrored, star, static_cast<float>(depth)}, static_cast<float>(dot(d, frame.first) / depth),
             static_cast<float>(dot(d, frame.second) / depth));
  }
}

Vector3<double> RoughImageFinder::as_patches_see(const FieldStar& star, bool mirrored) const {
  const Vector3<double>& d = star.direction;
  return {cosine_phi_ * d.x + sine_phi_ * d.y, cosine_phi_ * d.y - sine_phi_ * d.x, mirrored ? -d.z : d.z};
}

void RoughImageFinder::finish(std::vector<RoughImage>& found) {
  finish_regular(found);
  finish_bent(found);
  search_folded(folded_, found);
  regular_.clear();
  bent_.clear();
  folded_.clear();
}

void RoughImageFinder::invert(const PairList& list, float farthest, int rounds) {
  const std::size_t count = list.pairs.size();
  roots_.resize(4 * count);
  float* const roots = roots_.data();
  invert_patches({list.batch(), farthest, rounds, roots, roots + count, roots + 2 * count, roots + 3 * count});
}

bool RoughImageFinder::within(std::size_t pair) const {
  const std::size_t count = roots_.size() / 4;
  return roots_[pair] != 0.0F && within_patch<float>({roots_[count + pair], roots_[2 * count + pair]}, beyond_patch);
}

void RoughImageFinder::finish_regular(std::vector<RoughImage>& found) {
  invert(regular_, farthest_regular, rounds_regular);
  const std::size_t count = regular_.pairs.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (within(i)) {
      keep(regular_.pairs[i], {roots_[count + i], roots_[2 * count + i], roots_[3 * count + i]}, found);
    }
  }
}

void RoughImageFinder::finish_bent(std::vector<RoughImage>& found) {
  sides_.resize(bent_.pairs.size());
  find_patch_sides({bent_.batch(), sides_.data()});
  PairList held;
  for (std::size_t i = 0; i < bent_.pairs.size(); ++i) {
    if (sides_[i] != static_cast<float>(PatchSide::outside)) {
      held.add(bent_.pairs[i], bent_.a[i], bent_.b[i]);
      sides_[held.pairs.size() - 1] = sides_[i];
    }
  }
  invert(held, any_step, rounds_bent);
  const std::size_t count = held.pairs.size();
  PairList missed;
  for (std::size_t i = 0; i < count; ++i) {
    if (within(i)) {
      keep(held.pairs[i], {roots_[count + i], roots_[2 * count + i], roots_[3 * count + i]}, found);
    } else if (sides_[i] == static_cast<float>(PatchSide::inside) || roots_[i] == 0.0F ||
               !within_patch<float>({roots_[count + i], roots_[2 * count + i]}, near_outside)) {
      missed.add(held.pairs[i], held.a[i], held.b[i]);
    }
  }
  search_folded(missed, found);
}

void RoughImageFinder::search_folded(const PairList& list, std::vector<RoughImage>& found) {
  asked_.clear();
  for (const Pair& pair : list.pairs) {
    const StarPatch& patch = *pair.patch;
    asked_.push_back({patch.halvings, patch.error, patch.shape == PatchShape::bent ? 1 : most_roots});
  }
  folded_search_.search(list.batch(), asked_);
  for (std::size_t i = 0; i < list.pairs.size(); ++i) {
    for (const FoldedRoot& root : folded_search_.roots(i)) {
      keep(list.pairs[i], root, found);
    }
  }
}

void RoughImageFinder::keep(const Pair& pair, const FoldedRoot& root, std::vector<RoughImage>& found) const {
  const StarPatch& patch = *pair.patch;
  const FieldStar& star = field_.stars()[static_cast<std::size_t>(pair.star)];
  const float sky = sky_of_root(root.area, pair.depth);
  const ShiftGain& shift = field_.gains().row(patch.light.shift_row);
  const float gain = most_gain(patch, sky) * shift.gain[star_class(star.log_temperature)];
  if (star.illuminance * gain >= patches_.faintest()) {
    ChartImage image = chart_image(patch, root, sky);
    const bool exact = patch.exact && patch.shape != PatchShape::folded &&
                       patches_.mended().mend(patch.leaf, as_patches_see(star, pair.mirrored), image);
    const float seen = pair.mirrored ? 1.0F - image.gamma_turns : image.gamma_turns;
    found.push_back({pair.star, seen - std::floor(seen), image.s, image.sky, patch.brighter, exact, root.area == 0.0F});
  }
}

}  // namespace ergodome
