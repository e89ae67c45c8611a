#include "render/passes/stars/search/rough_images.h"

#include <algorithm>
#include <memory>
#include <mutex>

#include "kernels/launch/launch.h"
#include "kernels/launch/parallel_for.h"
#include "kernels/launch/work_counter.h"
#include "kernels/stars/search/search_steps.h"

namespace ergodome {

namespace {

//! Number of patches that a thread takes at a time.
constexpr int patches_a_part = 512;

//! Pool of finders, so that each keeps its allocated memory.
class FinderPool {
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

PatchPairBatch RoughImageFinder::batch_of(const Pairs& pairs) const {
  return {static_cast<int>(pairs.size()), pairs.data(), inputs_.patches};
}

void RoughImageFinder::add_patch(int number, bool mirrored) {
  const StarPatch& patch = inputs_.patches[number];
  int count = 0;
  run_on_this_thread(StarSearchBatch{&inputs_.field, turned(patch.part, inputs_.turn, mirrored),
                                     floor_of(patch, inputs_.faintest), stars_.data(), &count});
  Pairs& pairs = pairs_in(patch.shape);
  for (int i = 0; i < count; ++i) {
    pairs.push_back(pair_of(inputs_, number, mirrored, stars_[static_cast<std::size_t>(i)]));
  }
}

void RoughImageFinder::finish(std::vector<RoughImage>& found) {
  undecided_.clear();
  sides_.clear();
  invert(pairs_in(PatchShape::regular), PatchShape::regular, found);
  drop_outside(pairs_in(PatchShape::bent));
  invert(pairs_in(PatchShape::bent), PatchShape::bent, found);
  search_folded(undecided_, found);
  search_folded(pairs_in(PatchShape::folded), found);
  for (Pairs& pairs : pairs_) {
    pairs.clear();
  }
}

//! Inverts pairs by Newton's method; keeps images, and adds undecided pairs to `undecided_`.
void RoughImageFinder::invert(const Pairs& pairs, PatchShape shape, std::vector<RoughImage>& found) {
  const std::size_t count = pairs.size();
  roots_.resize(4 * count);
  float* const was_found = roots_.data();
  float* const u = was_found + count;
  float* const v = u + count;
  float* const area = v + count;
  run_on_this_thread(PatchNewtonBatch{batch_of(pairs), newton_limits(shape), was_found, u, v, area});
  for (std::size_t i = 0; i < count; ++i) {
    const PatchSide side = shape == PatchShape::bent ? static_cast<PatchSide>(sides_[i]) : PatchSide::inside;
    switch (pair_result(shape, side, was_found[i] != 0.0F, u[i], v[i])) {
      case PairResult::image:
        keep(pairs[i], {u[i], v[i], area[i]}, found);
        break;
      case PairResult::undecided:
        undecided_.push_back(pairs[i]);
        break;
      case PairResult::no_image:
        break;
    }
  }
}

//! Drops the pairs whose stars are outside the border of their patch, so that they occupy no lanes
//! in Newton's method. Keeps the values of `sides_` for the other pairs.
void RoughImageFinder::drop_outside(Pairs& pairs) {
  sides_.resize(pairs.size());
  run_on_this_thread(PatchSideBatch{batch_of(pairs), sides_.data()});
  std::size_t kept = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (static_cast<PatchSide>(sides_[i]) != PatchSide::outside) {
      pairs[kept] = pairs[i];
      sides_[kept] = sides_[i];
      ++kept;
    }
  }
  pairs.resize(kept);
}

void RoughImageFinder::search_folded(const Pairs& pairs, std::vector<RoughImage>& found) {
  folded_search_.search(batch_of(pairs));
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    for (const FoldedRoot& root : folded_search_.roots(i)) {
      keep(pairs[i], root, found);
    }
  }
}

void RoughImageFinder::keep(const SearchedPair& pair, const FoldedRoot& root, std::vector<RoughImage>& found) const {
  RoughImage image{};
  if (image_at_root(inputs_, pair, root, image)) {
    found.push_back(image);
  }
}

int rough_parts(int patch_count) { return (patch_count + patches_a_part - 1) / patches_a_part; }

void find_rough_images(const SearchInputs& inputs, std::size_t star_count,
                       const std::function<void(int, const std::vector<RoughImage>&)>& found) {
  static WorkCounter counter("search_patches");
  const WorkScope work(counter, inputs.patch_count);
  FinderPool idle;
  parallel_for(rough_parts(inputs.patch_count), 1, [&](int begin, int end) {
    FinderPool::Finder finder = idle.take();
    if (!finder) {
      finder = std::make_unique<RoughImageFinder>(inputs, star_count);
    }
    std::vector<RoughImage> images;
    for (int part = begin; part < end; ++part) {
      const int last = std::min((part + 1) * patches_a_part, inputs.patch_count);
      for (int i = part * patches_a_part; i < last; ++i) {
        for (int side = 0; side < inputs.sides; ++side) {
          const bool mirrored = side == 1;
          if (may_be_seen(inputs.view, inputs.patches[i], mirrored)) {
            finder->add_patch(i, mirrored);
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
