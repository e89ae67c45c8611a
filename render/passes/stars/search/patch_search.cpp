#include "render/passes/stars/search/patch_search.h"

#include <algorithm>
#include <functional>

#include "kernels/launch/launch.h"
#include "kernels/launch/work_counter.h"
#include "render/passes/stars/search/sky_frustum.h"

namespace ergodome {

namespace {

//! Number of threads that search the stars of one patch. They form a warp and read adjacent stars.
constexpr int threads_of_a_patch = 32;
//! Minimum capacity for parts. With a capacity of zero, no part would be counted as lost, and the
//! lack of memory would not be noticed.
constexpr std::size_t min_parts = 1024;

}  // namespace

void PlacedPatches::set(const StarPatches& patches, const LensStation& station) {
  arrays_.begin();
  const auto put = [this](const auto& values) { return arrays_.put(values); };
  batch_ = {};
  batch_.inputs = patches.view(put);
  batch_.chart = grid_view(station).chart;
  batch_.chart.edge.polar_angle = put(station.edge);
  batch_.deepest = 0;
  for (const StarPatch& patch : patches.patches()) {
    batch_.deepest = std::max(batch_.deepest, patch.halvings);
  }
}

PatchSearch::PatchSearch(Backend backend, const StarField& field, const BlackbodyTable& colours, int room)
    : backend_(backend),
      arrays_(backend),
      field_(field.view([this](const auto& values) { return arrays_.put(values); })),
      colours_(colours),
      counts_(backend, list_count, "star search") {
  colours_.entries = arrays_.put(std::vector<float>(colours.entries, colours.entries + 4L * colours.count));
  Counts wanted;
  wanted.fill(room);
  make_room(wanted);
}

//! Enlarges the lists to at least these lengths. If memory runs out, Buffer throws, and all
//! capacities are left at zero.
void PatchSearch::make_room(const Counts& wanted) {
  const auto count_of = [&](int list) { return static_cast<std::size_t>(wanted[static_cast<std::size_t>(list)]); };
  const auto room_of = [](std::size_t size) { return static_cast<std::int32_t>(size); };
  constexpr const char* name = "star search";
  rooms_ = {};
  for (int i = 0; i < 3; ++i) {
    reserve(backend_, count_of(i), name, pairs_[i]);
  }
  reserve(backend_, count_of(images), name, images_);
  reserve(backend_, count_of(exact), name, exact_);
  for (Buffer<float>& list : parts_) {
    reserve(backend_, part_channels * std::max(count_of(halved), min_parts), name, list);
  }
  const std::size_t room = std::ranges::min_element(parts_, {}, &Buffer<float>::size)->size() / part_channels;
  reserve(backend_, room, name, regular_roots_);
  reserve(backend_, max_part_roots * room, name, folded_roots_);
  reserve(backend_, (1 + max_part_roots) * room, name, roots_);
  reserve(backend_, 2 * max_searched_together, name, root_counts_);
  reserve(backend_, 2 * max_searched_together + 1, name, root_first_);
  rooms_.fill(room_of(room));
  for (std::size_t i = 0; i < 3; ++i) {
    rooms_[i] = room_of(pairs_[i].size());
  }
  rooms_[images] = room_of(images_.size());
  rooms_[exact] = room_of(exact_.size());
  rooms_[lost_parts] = 0;
}

void PatchSearch::share(PatchSearchBatch& batch) const {
  for (std::size_t i = 0; i < 3; ++i) {
    batch.pairs[i] = {pairs_[i].data(), rooms_[i], counts_.data() + i};
  }
  batch.images = {images_.data(), rooms_[images], counts_.data() + images};
  batch.exact = {exact_.data(), rooms_[exact], counts_.data() + exact};
  const auto parts = [&](std::size_t i) {
    return SharedParts{parts_[i].data(), rooms_[halved + i], counts_.data() + halved + i, counts_.data() + lost_parts};
  };
  batch.halved[0] = parts(0);
  batch.halved[1] = parts(1);
  batch.regular_parts = parts(2);
  batch.folded_parts = parts(3);
  batch.regular_roots = regular_roots_.data();
  batch.folded_roots = folded_roots_.data();
  batch.root_counts = root_counts_.data();
  batch.root_first = root_first_.data();
  batch.roots = roots_.data();
}

PatchSearch::Counts PatchSearch::counts() const {
  Counts counts;
  counts_.read(counts.data(), counts.size());
  return counts;
}

bool PatchSearch::have_room(const Counts& counts) const {
  return std::equal(counts.begin(), counts.end(), rooms_.begin(), std::less_equal<>());
}

//! Runs a step on `count` patches, pairs or parts.
void PatchSearch::run(PatchSearchBatch& batch, PatchSearchStep step, int count, int depth) const {
  batch.step = step;
  batch.count = count;
  batch.depth = depth;
  launch(backend_, batch);
}

//! Searches some of the pairs of folded patches. Only the GPU knows the number of parts in each
//! step, so steps run for the capacity of their list: reading the number would take longer than
//! running threads that have nothing to do.
void PatchSearch::search_slice(PatchSearchBatch batch, int pairs) {
  clear(backend_, counts_, 4, halved);
  run(batch, PatchSearchStep::see_folded, pairs);
  for (int depth = 0; depth < batch.deepest; ++depth) {
    const SharedParts& to = batch.halved[1 - depth % 2];
    clear(backend_, counts_, 1, static_cast<std::size_t>(halves - depth % 2));
    run(batch, PatchSearchStep::halve, to.room, depth);
  }
  const auto lists = 2 * static_cast<std::size_t>(pairs);
  clear(backend_, root_counts_, lists);
  run(batch, PatchSearchStep::solve_regular, batch.regular_parts.room);
  run(batch, PatchSearchStep::solve_folded, batch.folded_parts.room);
  sum_counts(backend_, root_counts_.data(), 2 * pairs, root_first_.data());
  clear(backend_, root_counts_, lists);
  run(batch, PatchSearchStep::list_regular, batch.regular_parts.room);
  run(batch, PatchSearchStep::list_folded, batch.folded_parts.room);
  run(batch, PatchSearchStep::take_roots, pairs);
}

//! Runs all steps of a search and returns the lengths of the lists. If one exceeds its capacity,
//! the result is incomplete, and the search must be repeated with a larger list.
PatchSearch::Counts PatchSearch::search(PatchSearchBatch batch) {
  clear(backend_, counts_, list_count);
  run(batch, PatchSearchStep::find_pairs, batch.patch_threads * batch.inputs.sides * batch.inputs.patch_count);
  run(batch, PatchSearchStep::regular, rooms_[regular]);
  run(batch, PatchSearchStep::bent, rooms_[bent]);
  // Each pair of a folded patch starts as one part. Usually there are few pairs, so the first slice
  // is searched before their number is known.
  const int slice = std::min({max_searched_together, rooms_[halved], rooms_[folded]});
  if (slice == 0) {
    return counts();
  }
  Counts found{};
  for (batch.first_folded = 0; batch.first_folded == 0 || (have_room(found) && batch.first_folded < found[folded]);
       batch.first_folded += slice) {
    search_slice(batch, slice);
    found = counts();
  }
  return found;
}

PatchSearch::Result PatchSearch::find(const PlacedPatches& patches, const Request& request) {
  static WorkCounter counter("search_patches");
  const DeviceWorkInOrder in_order(backend_);
  PatchSearchBatch batch = patches.batch();
  batch.patch_threads = threads_of_a_patch;
  const WorkScope work(counter, batch.inputs.patch_count);
  batch.inputs.field = field_;
  batch.inputs.view = request.view;
  batch.inputs.turn = sky_rotation(request.phi);
  batch.completes = request.observer.is_one_camera();
  batch.energy = request.observer.energy();
  batch.observer = request.observer.observer();
  batch.colours = colours_;
  batch.appearance = request.appearance;
  share(batch);
  Counts found = search(batch);
  while (!have_room(found)) {
    // Enlarges all lists, because it is unknown how many parts the lost ones would have produced.
    for (const int list : {halved, halves, last_regular, last_folded}) {
      found[static_cast<std::size_t>(list)] = rooms_[halved] + found[lost_parts];
    }
    make_room(found);
    share(batch);
    found = search(batch);
  }
  Result result;
  result.rough.resize(static_cast<std::size_t>(found[images]));
  images_.read(result.rough.data(), result.rough.size());
  result.exact = {exact_.data(), found[exact]};
  return result;
}

}  // namespace ergodome
