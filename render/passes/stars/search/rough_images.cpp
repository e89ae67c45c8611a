#include "render/passes/stars/search/rough_images.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>

#include "kernels/launch/launch.h"
#include "kernels/launch/parallel_for.h"
#include "kernels/launch/work_counter.h"
#include "kernels/stars/search/search_rules.h"

namespace ergodome {

namespace {

//! Number of patches that a thread takes at a time.
constexpr int patches_a_part = 128;

//! Returns whether the view may overlap a patch, or its mirror image if `mirrored`.
bool may_be_seen(const StarPatch& patch, bool mirrored, const ViewCone& view) {
  const float side = mirrored ? -1.0F : 1.0F;
  const Vector3<double> way = {static_cast<double>(patch.seen.x), static_cast<double>(side * patch.seen.y),
                               static_cast<double>(patch.seen.z)};
  return may_touch(view, way, static_cast<double>(patch.seen_radius));
}

//! Pool of finders, so that each keeps its allocated memory.
class IdleFinders {
 public:
  using Finder = std::unique_ptr<RoughImageFinder>;

  //! Returns an idle finder, or nullptr.
  Finder take() {
    const std::lock_guard lock(mutex_);
    if (finders_.empty()) {
      return nullptr;
    }
    Finder last = std::move(finders_.back());
    finders_.pop_back();
    return last;
  }

  void give_back(Finder finder) {
    const std::lock_guard lock(mutex_);
    finders_.push_back(std::move(finder));
  }

 private:
  std::mutex mutex_;
  std::vector<Finder> finders_;
};

}  // namespace

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
  run_on_this_thread(
      PatchNewtonBatch{list.batch(), farthest, rounds, roots, roots + count, roots + 2 * count, roots + 3 * count});
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
  run_on_this_thread(PatchSideBatch{bent_.batch(), sides_.data()});
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

int rough_parts(const StarPatches& patches) {
  return static_cast<int>((patches.patches().size() + patches_a_part - 1) / patches_a_part);
}

void find_rough_images(const StarField& field, double phi, const StarPatches& patches, const ViewCone& view,
                       const std::function<void(int, const std::vector<RoughImage>&)>& found) {
  static WorkCounter counter("search_patches");
  const WorkScope work(counter, static_cast<long>(patches.patches().size()));
  const auto& list = patches.patches();
  const int count = static_cast<int>(list.size());
  IdleFinders idle;
  parallel_for(rough_parts(patches), 1, [&](int begin, int end) {
    IdleFinders::Finder finder = idle.take();
    if (!finder) {
      finder = std::make_unique<RoughImageFinder>(patches, field, phi);
    }
    std::vector<RoughImage> images;
    for (int part = begin; part < end; ++part) {
      for (int i = part * patches_a_part; i < std::min((part + 1) * patches_a_part, count); ++i) {
        const StarPatch& patch = list[static_cast<std::size_t>(i)];
        for (const bool mirrored : {false, true}) {
          if ((!mirrored || patches.mirrored()) && may_be_seen(patch, mirrored, view)) {
            finder->look_in(patch, mirrored);
          }
        }
      }
      images.clear();
      finder->finish(images);
      found(part, images);
    }
    idle.give_back(std::move(finder));
  });
}

}  // namespace ergodome
