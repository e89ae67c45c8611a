#include "render/stars/patch_search.h"

#include <algorithm>
#include <cmath>

#include "kernels/launch/launch.h"
#include "kernels/launch/work_counter.h"
#include "render/stars/sky_frustum.h"

namespace ergodome {

void PlacedPatches::set(const StarPatches& patches) {
  arrays_.begin();
  const auto put = [this](const auto& values) { return arrays_.put(values); };
  batch_ = {};
  batch_.patches = put(patches.patches());
  batch_.patch_count = static_cast<int>(patches.patches().size());
  batch_.sides = patches.mirrored() ? 2 : 1;
  batch_.faintest = patches.faintest();
  batch_.mended = patches.mended().view(put);
}

PatchSearch::PatchSearch(Backend backend, const StarField& field, int room)
    : backend_(backend),
      arrays_(backend),
      field_(field.view([this](const auto& values) { return arrays_.put(values); })) {
  lists_.counts = Buffer<std::int32_t>(backend, list_count, "star search");
  grow(std::vector<std::int32_t>(list_count, room));
}

void PatchSearch::share(PatchSearchBatch& batch) const {
  for (int i = 0; i < list_count - 1; ++i) {
    const Buffer<SearchedPair>& pairs = lists_.pairs[i];
    batch.pairs[i] = {pairs.data(), static_cast<int>(pairs.size()), lists_.counts.data() + i};
  }
  batch.images = {lists_.images.data(), static_cast<int>(lists_.images.size()), lists_.counts.data() + list_count - 1};
}

std::vector<std::int32_t> PatchSearch::counts() const {
  std::vector<std::int32_t> counts(list_count);
  lists_.counts.read(counts.data(), counts.size());
  return counts;
}

//! Makes room for so much; false where there is room already.
bool PatchSearch::grow(const std::vector<std::int32_t>& counts) {
  bool grown = false;
  const auto make_room = [&](std::int32_t count, auto& buffer) {
    grown = grown || buffer.size() < static_cast<std::size_t>(count);
    reserve(backend_, static_cast<std::size_t>(count), "star search", buffer);
  };
  for (std::size_t i = 0; i < list_count - 1; ++i) {
    make_room(counts[i], lists_.pairs[i]);
  }
  make_room(counts[list_count - 1], lists_.images);
  return grown;
}

//! False where lists were too short, and are longer now.
bool PatchSearch::search(const PatchSearchBatch& batch, std::vector<RoughImage>& images) {
  clear(backend_, lists_.counts, list_count);
  search_patches(backend_, batch, PatchSearchStep::find_pairs, batch.sides * batch.patch_count);
  std::vector<std::int32_t> found = counts();
  if (grow(found)) {
    return false;
  }
  const auto count_of = [&](PatchShape shape) { return found[static_cast<std::size_t>(shape)]; };
  search_patches(backend_, batch, PatchSearchStep::regular, count_of(PatchShape::regular));
  search_patches(backend_, batch, PatchSearchStep::bent, count_of(PatchShape::bent));
  found = counts();
  if (grow(found)) {
    return false;
  }
  search_patches(backend_, batch, PatchSearchStep::folded, count_of(PatchShape::folded));
  found = counts();
  if (grow(found)) {
    return false;
  }
  images.resize(static_cast<std::size_t>(found.back()));
  lists_.images.read(images.data(), images.size());
  return true;
}

std::vector<RoughImage> PatchSearch::find(const PlacedPatches& patches, double phi, const ViewCone& view) {
  static WorkCounter counter("search_patches");
  PatchSearchBatch batch = patches.batch();
  const WorkScope work(counter, batch.patch_count);
  batch.view_axis = view.axis;
  batch.view_half_angle = view.half_angle;
  batch.view_cosine = view.cosine;
  batch.turn = sky_turn(phi);
  batch.sine_phi = std::sin(phi);
  batch.cosine_phi = std::cos(phi);
  batch.field = field_;
  std::vector<RoughImage> images;
  do {
    share(batch);
  } while (!search(batch, images));
  return images;
}

}  // namespace ergodome
