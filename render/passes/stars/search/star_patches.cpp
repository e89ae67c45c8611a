#include "render/passes/stars/search/star_patches.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "kernels/launch/launch.h"
#include "kernels/launch/parallel_for.h"
#include "kernels/spacetime/shadow/shadow_chart.h"
#include "render/passes/stars/drawing/edge_rounding.h"

namespace ergodome {

namespace {

//! Maximum number of halvings of a leaf. It is reached next to a critical curve, where no patch is
//! regular.
constexpr int deepest_patch = 12;
//! Number of stars that a patch may contain above which the patch is halved if it is not regular.
//! Patches that may be folded are searched by halving, in each picture, which costs more than
//! Newton's method.
constexpr double few_stars = 12.0;
constexpr double few_stars_folded = 4.0;
//! Number of halvings in the search for images in a folded patch. Patches that were themselves
//! halved less often get more.
constexpr int search_halvings = 8;
constexpr int leaves_a_chunk = 16;
//! Cosine of the maximum half angle of the cone that contains a narrow patch (Extent). The bounds
//! of wider patches would include many stars that the patch does not contain, so these are halved.
//! The exception are broad ones that are not folded and may contain only `few_stars_broad`: next to
//! the shadow's edge, where images are faint, and a leaf spans a large part of the sky.
constexpr double widest_cosine = 0.94;
constexpr double broadest_cosine = 0.7;
constexpr double few_stars_broad = 4.0;
//! Solid angle on the sky below which large magnifications are neglected [sr]. Next to a critical
//! curve images may be arbitrarily bright, but this is rare: in a patch of solid angle w on the
//! camera's sky, magnifications above M affect at most w / M of the stars' sky.
constexpr float neglected_sky = 1e-8F;

//! Extent of a patch on the sky.
enum class Extent {
  none,   //!< not a part of the sky, because some nodes see no light
  half,   //!< so large that it may cover half of the sky
  wide,   //!< has a bounding cone with an axis, but is too wide for bounds by planes
  broad,  //!< bounds by planes would include many stars outside the patch
  narrow  //!< narrow enough for bounds by planes
};

//! Returns the extent of a patch and, unless that is `none`, the direction of its center in `axis`.
Extent extent_of(const BezierPatch& patch, Vector3<double>& axis) {
  const Vector3<double> sum =
      control_point(patch, 0) + control_point(patch, 3) + control_point(patch, 12) + control_point(patch, 15);
  if (!(dot(sum, sum) > 1e-6)) {
    return Extent::none;
  }
  axis = normalized(sum);
  double cosine = 1.0;
  for (int i = 0; i < 16; ++i) {
    const Vector3<double> p = control_point(patch, i);
    const double square = dot(p, p);
    cosine = std::min(cosine, square > 1e-6 ? dot(p, axis) / std::sqrt(square) : -1.0);
  }
  if (cosine > broadest_cosine) {
    return cosine > widest_cosine ? Extent::narrow : Extent::broad;
  }
  return cosine > 0.1 ? Extent::wide : Extent::half;
}

//! How a patch changes solid angles.
struct Stretching {
  bool folded;  //!< true if the lens map is mirrored in a part of the patch
  //! Largest ratio of camera to sky solid angle; in a folded patch, without a negligible part of
  //! the sky.
  float magnification;
};

//! Returns the magnification M beyond which images in a folded patch are neglected. Near a critical
//! curve, the sky's solid angle per area of the chart goes linearly through zero. Images brighter
//! than M-fold are where that ratio is below camera_rate / M: in a strip of the chart whose width
//! is proportional to 1 / M, and which covers a part of the sky proportional to 1 / M².
float folded_magnification(float camera_rate, float sky_range, float chart_area) {
  constexpr float margin = 2.0F;
  return margin * camera_rate * std::sqrt(chart_area / (std::max(sky_range, 1e-30F) * neglected_sky));
}

Stretching stretching_of(const PatchMeasures& measures, const StarPatch& patch) {
  constexpr float max_between_samples = 2.0F;
  const float sky_range = measures.highest_sky - measures.lowest_sky;
  // The margin accounts for folds between samples.
  if (measures.lowest_sky > 0.05F * sky_range || measures.highest_sky < -0.05F * sky_range) {
    // Samples are a quarter of the patch apart, so no point is farther than an eighth of the patch
    // from a sample. A quantity that changes steadily changes over that distance by the eighth root
    // of its total ratio.
    const float low = std::min(std::abs(measures.lowest_sky), std::abs(measures.highest_sky));
    const float high = std::max(std::abs(measures.lowest_sky), std::abs(measures.highest_sky));
    const float between_samples = std::min(std::sqrt(std::sqrt(std::sqrt(high / low))), max_between_samples);
    return {false, between_samples * measures.max_ratio};
  }
  return {true, folded_magnification(measures.largest_camera, sky_range, patch.width_turns * patch.height)};
}

//! Returns the maximum factor by which an image may be brighter than according to the grid: the
//! bound from the grid's error (`by_error`), limited by the largest errors that were found in
//! tests. The limit is 1.35 in regular patches and 2 to 8 in bent ones; folded ones always get 8.
float max_brighter(float by_error, PatchShape shape) {
  constexpr float min_bend = 2.0F;
  constexpr float max_regular = 1.35F;
  constexpr float maximum = 8.0F;
  switch (shape) {
    case PatchShape::regular:
      return std::min(by_error, max_regular);
    case PatchShape::bent:
      return std::clamp(by_error, min_bend, maximum);
    // The search covers folds within the grid's error around their positions in the grid.
    case PatchShape::folded:
      break;
  }
  return maximum;
}

//! Returns the axis of the chart along which a patch is longer on the sky: 0 for γ, 1 for s.
int longer_axis(const BezierPatch& patch) {
  const auto distance = [&](int i, int j) {
    const Vector3<double> d = control_point(patch, i) - control_point(patch, j);
    return dot(d, d);
  };
  return distance(0, 3) + distance(12, 15) >= distance(0, 12) + distance(3, 15) ? 0 : 1;
}

}  // namespace

StarPatches::StarPatches(const LensStation& station, const StarField& field, const ImageLight& light, float faintest,
                         const GridExactness& exactness, PatchRoom& room)
    : corrected_(station),
      edge_(station.edge),
      chart_(grid_view(station).chart),
      mirrored_(station.mirrored),
      faintest_(faintest),
      exactness_(exactness) {
  chart_.edge.polar_angle = edge_.data();
  const LensGrid grid = grid_view(station);
  const std::vector<LeafBox> boxes = leaf_boxes(station);
  const int leaves = static_cast<int>(boxes.size());
  std::vector<std::vector<StarPatch>>& parts = room.parts;
  parts.resize(static_cast<std::size_t>((leaves + leaves_a_chunk - 1) / leaves_a_chunk));
  parallel_for(static_cast<int>(parts.size()), 1, [&](int begin, int end) {
    for (int part = begin; part < end; ++part) {
      parts[static_cast<std::size_t>(part)].clear();
    }
    for (int leaf = begin * leaves_a_chunk; leaf < std::min(end * leaves_a_chunk, leaves); ++leaf) {
      const LeafBox& box = boxes[static_cast<std::size_t>(leaf)];
      StarPatch patch{};
      patch.gamma_turns = static_cast<float>(box.gamma_turns);
      patch.s = static_cast<float>(box.s);
      patch.width_turns = static_cast<float>(box.width_turns);
      patch.height = static_cast<float>(box.height);
      patch.sky = bezier_patch(grid, leaf, patch.width_turns, patch.height);
      const auto number = static_cast<std::size_t>(leaf);
      patch.leaf = leaf;
      set_error(station.leaf_error_px[number], patch);
      add_patch({field, light}, patch, 0, parts[static_cast<std::size_t>(leaf / leaves_a_chunk)]);
    }
  });
  join(room);
}

StarPatches::StarPatches(StarPatches&& other, std::vector<StarPatch> patches) : StarPatches(std::move(other)) {
  patches_ = std::move(patches);
}

StarPatches::StarPatches(const StarPatches& middle, const LensStation& there, std::vector<float> nodes,
                         std::vector<StarPatch> patches)
    : corrected_(middle.corrected_, std::move(nodes)),
      edge_(there.edge),
      chart_(grid_view(there).chart),
      mirrored_(middle.mirrored_),
      faintest_(middle.faintest_),
      exactness_(middle.exactness_),
      patches_(std::move(patches)) {
  chart_.edge.polar_angle = edge_.data();
}

//! Concatenates the patches of all chunks (PatchRoom::parts), in order.
void StarPatches::join(PatchRoom& room) {
  const std::vector<std::vector<StarPatch>>& parts = room.parts;
  std::vector<std::size_t> first(parts.size() + 1, 0);
  std::transform_inclusive_scan(parts.begin(), parts.end(), first.begin() + 1, std::plus(),
                                [](const std::vector<StarPatch>& part) { return part.size(); });
  patches_ = std::move(room.patches);
  if (patches_.capacity() < first.back()) {
    // Frees the memory first, because resize() would copy its contents, which are not needed.
    patches_ = {};
  }
  patches_.resize(first.back());
  constexpr int parts_a_chunk = 8;
  parallel_for(static_cast<int>(parts.size()), parts_a_chunk, [&](int begin, int end) {
    for (auto part = static_cast<std::size_t>(begin); part < static_cast<std::size_t>(end); ++part) {
      std::ranges::copy(parts[part], patches_.begin() + static_cast<std::ptrdiff_t>(first[part]));
    }
  });
}

//! Sets `brighter` and `exact` of a leaf's patch from the errors that the leaf's check rays
//! measured. `error_px`: error of the leaf.
void StarPatches::set_error(float error_px, StarPatch& patch) const {
  // A cubic with error e on a side of length h has a slope error of e √3 384 / (216 h). To first
  // order, the relative error of the magnification is the sum of the slope errors of γ along γ and
  // of s along s.
  constexpr float slope_error = 3.1F;
  // After the correction, the leading error is a quintic, (t (1 - t))² (t - 1/2), whose slope is
  // this multiple of its value at the inner checks.
  constexpr float corrected_slope_error = 7.1F;
  constexpr float exact_magnification = 6e-3F;
  constexpr float between_checks = 3.0F;
  // The first-order correction is not valid if a check ray is displaced by more than this fraction
  // of a leaf's side.
  constexpr float max_displaced = 0.03F;
  const LeafErrors errors = corrected_.errors(patch.leaf);
  const float magnification_error = slope_error * errors.displaced;
  // Relative rounding error of the magnification, because nodes are traced in single precision.
  const auto rounding = static_cast<float>(edge_rounding / edge_distance(chart_, static_cast<double>(patch.s)));
  patch.brighter = 1.0F + between_checks * (magnification_error + rounding);
  const float left_px = error_px * std::min(errors.left / std::max(errors.displaced, 1e-30F), 1.0F);
  patch.exact = errors.displaced <= max_displaced && left_px <= exact_grid_px &&
                corrected_slope_error * errors.left <= exact_magnification;
}

bool StarPatches::is_done(const Wanted& wanted, const StarPatch& patch, const SkyFrustum& frustum, bool broad) const {
  const double share = solid_angle(frustum) / (4.0 * 3.14159265358979323846);
  const double stars = wanted.field.count_from(floor_of(patch, faintest_)) * std::min(share, 1.0);
  if (broad) {
    return patch.shape != PatchShape::folded && stars <= few_stars_broad;
  }
  return patch.shape == PatchShape::regular ||
         stars <= (patch.shape == PatchShape::folded ? few_stars_folded : few_stars);
}

void StarPatches::add_patch(const Wanted& wanted, const StarPatch& patch, int depth,
                            std::vector<StarPatch>& patches) const {
  Vector3<double> middle;
  const Extent extent = extent_of(patch.sky, middle);
  const bool last = depth >= deepest_patch;
  if (extent == Extent::narrow || extent == Extent::broad || (extent == Extent::wide && last)) {
    StarPatch own = patch;
    own.frame = frame_of(patch.sky, middle);
    own.sky = in_frame(patch.sky, own.frame);
    own.halvings = search_halvings + (deepest_patch - depth) / 2;
    PatchMeasures measures;
    run_on_this_thread(PatchMeasureBatch{&own.sky, chart_, own.gamma_turns, own.s, own.width_turns, own.height,
                                         wanted.light.energy(), wanted.light.observer(), &measures});
    const Stretching stretching = stretching_of(measures, own);
    own.shape = stretching.folded ? PatchShape::folded : measures.regular ? PatchShape::regular : PatchShape::bent;
    own.error = stretching.folded ? static_cast<float>(exactness_.fold_error) : 0.0F;
    const SkyFrustum frustum = frustum_of(own.sky, own.frame, static_cast<double>(own.error));
    own.light = wanted.light.light_in(measures.brightening, measures.frequency_ratio);
    own.seen = measures.seen;
    // Enlarges the radius, because chords are shorter than angles, and sides may bulge between the
    // sampled positions.
    own.seen_radius = 1.6F * measures.seen_radius;
    own.max_camera = 1.1F * measures.largest_camera * own.width_turns * own.height;
    own.brighter = max_brighter(patch.brighter, own.shape);
    own.magnification = stretching.magnification * (stretching.folded ? 1.0F : own.brighter);
    if (wanted.field.count_from(floor_of(own, faintest_)) == 0) {
      return;
    }
    if (last || is_done(wanted, own, frustum, extent == Extent::broad)) {
      own.part = sky_part(frustum);
      patches.push_back(own);
      return;
    }
  } else if (last) {
    return;
  }
  const int axis = longer_axis(patch.sky);
  StarPatch first = patch;
  StarPatch second = patch;
  split(patch.sky, axis, first.sky, second.sky);
  float& size = axis == 0 ? first.width_turns : first.height;
  size *= 0.5F;
  (axis == 0 ? second.width_turns : second.height) = size;
  (axis == 0 ? second.gamma_turns : second.s) += size;
  add_patch(wanted, first, depth + 1, patches);
  add_patch(wanted, second, depth + 1, patches);
}

}  // namespace ergodome
