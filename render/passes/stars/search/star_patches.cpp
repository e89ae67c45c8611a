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

//! Halvings of a leaf at the most, for regular patches; next to a critical curve no patch is regular.
constexpr int deepest_patch = 12;
//! Stars that a patch which is not regular may have to try before it is halved: what may be folded is searched by halving, at each
//! picture, and dearer than what is inverted.
constexpr double few_stars = 12.0;
constexpr double few_stars_folded = 4.0;
//! Halvings in search of images that stand for those that a patch was spared.
constexpr int search_halvings = 8;
constexpr int leaves_a_chunk = 16;
//! cos of the widest cone of a patch: wide ones would hold stars that they do not see.
constexpr double widest_cosine = 0.94;
//! Next to a critical curve images are as bright as one likes, but seldom: M-fold in a patch of solid angle w on the camera's sky are
//! those of w / M of the sky at the most. What less of the sky than this would show is not looked for.
constexpr float neglected_sky = 1e-8F;

//! How a patch lies on the sky.
enum class Extent {
  none,   //!< it is no part of the sky (nodes without light)
  half,   //!< it may span half of it
  wide,   //!< it has an axis
  narrow  //!< and is so small that planes do for the sky
};

//! Finds the axis of a patch.
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
  return cosine > widest_cosine ? Extent::narrow : cosine > 0.1 ? Extent::wide : Extent::half;
}

//! What a patch does to solid angles.
struct Stretching {
  bool folded;          //!< turned over in parts
  float magnification;  //!< greatest ratio of the camera's to the sky's; where folded, but for a part of the sky
};

//! Near a critical curve the sky's solid angle shrinks to nothing, steadily. Images are brighter than M-fold where its rate is below
//! camera rate / M, which is a strip of the chart whose width goes with 1 / M, and a part of the sky that goes with 1 / M²: this is the
//! M beyond which that part is neglected.
float folded_magnification(float camera_rate, float sky_range, float chart_area) {
  constexpr float margin = 2.0F;
  return margin * camera_rate * std::sqrt(chart_area / (std::max(sky_range, 1e-30F) * neglected_sky));
}

Stretching stretching_of(const PatchMeasures& measures, const StarPatch& patch) {
  constexpr float most_between_samples = 2.0F;
  const float sky_range = measures.highest_sky - measures.lowest_sky;
  // A fold may hide between samples.
  if (measures.lowest_sky > 0.05F * sky_range || measures.highest_sky < -0.05F * sky_range) {
    // Samples lie a quarter of the patch apart: half of that on, what changes steadily is off by the eighth root of what it changes by.
    const float low = std::min(std::abs(measures.lowest_sky), std::abs(measures.highest_sky));
    const float high = std::max(std::abs(measures.lowest_sky), std::abs(measures.highest_sky));
    const float between_samples = std::min(std::sqrt(std::sqrt(std::sqrt(high / low))), most_between_samples);
    return {false, between_samples * measures.greatest_ratio};
  }
  return {true, folded_magnification(measures.greatest_camera, sky_range, patch.width_turns * patch.height)};
}

//! What an image may be brighter than the grid makes it out to be: what the grid's error says, and no more than grids were found to be off
//! by, which in regular patches is mostly 1 %, seldom 30 %, and next to the shadow's edge, where patches are bent and images faint, many
//! times.
float most_brighter(float by_error, PatchShape shape) {
  constexpr float least_bent = 2.0F;
  constexpr float most_regular = 1.35F;
  constexpr float most = 8.0F;
  switch (shape) {
    case PatchShape::regular:
      return std::min(by_error, most_regular);
    case PatchShape::bent:
      return std::clamp(by_error, least_bent, most);
    // Folds are sought within the grid's error of where it has them.
    case PatchShape::folded:
      break;
  }
  return most;
}

//! The axis along which a patch is longer on the sky.
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
    : mended_(station),
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
      tell_error(station.leaf_error_px[number], patch);
      add_patch({field, light}, patch, 0, parts[static_cast<std::size_t>(leaf / leaves_a_chunk)]);
    }
  });
  join(room);
}

//! All parts' patches, in their order.
void StarPatches::join(PatchRoom& room) {
  const std::vector<std::vector<StarPatch>>& parts = room.parts;
  std::vector<std::size_t> first(parts.size() + 1, 0);
  std::transform_inclusive_scan(parts.begin(), parts.end(), first.begin() + 1, std::plus(),
                                [](const std::vector<StarPatch>& part) { return part.size(); });
  patches_ = std::move(room.patches);
  if (patches_.capacity() < first.back()) {
    // What lies in it is of no use.
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

//! What a leaf's errors at its check points say of the images in it. `error_px`: of its patch.
void StarPatches::tell_error(float error_px, StarPatch& patch) const {
  // A cubic that is off by e over a side h has a slope that is off by e √3 384 / (216 h). To first order an image's magnification is off
  // by how much γ is along itself and s is along itself, together.
  constexpr float slope_error = 3.1F;
  // Mended, it is off by a quintic first, (t (1 - t))² (t - 1/2), whose slope is so many times what it is at the inner checks.
  constexpr float mended_slope_error = 7.1F;
  constexpr float exact_magnification = 6e-3F;
  constexpr float between_checks = 3.0F;
  // Beyond this first order does not mend it.
  constexpr float most_mended = 0.03F;
  const LeafErrors errors = mended_.errors(patch.leaf);
  const float magnification_error = slope_error * errors.told;
  // Nodes are traced in float.
  const auto rounding = static_cast<float>(edge_rounding / edge_distance(chart_, static_cast<double>(patch.s)));
  patch.brighter = 1.0F + between_checks * (magnification_error + rounding);
  const float left_px = error_px * std::min(errors.left / std::max(errors.told, 1e-30F), 1.0F);
  patch.exact =
      errors.told <= most_mended && left_px <= exact_grid_px && mended_slope_error * errors.left <= exact_magnification;
}

bool StarPatches::is_done(const Wanted& wanted, const StarPatch& patch, const SkyFrustum& frustum) const {
  const double share = solid_angle(frustum) / (4.0 * 3.14159265358979323846);
  const double stars = wanted.field.count_from(floor_of(patch)) * std::min(share, 1.0);
  return patch.shape == PatchShape::regular ||
         stars <= (patch.shape == PatchShape::folded ? few_stars_folded : few_stars);
}

void StarPatches::add_patch(const Wanted& wanted, const StarPatch& patch, int depth,
                            std::vector<StarPatch>& patches) const {
  Vector3<double> middle;
  const Extent extent = extent_of(patch.sky, middle);
  const bool last = depth >= deepest_patch;
  if (extent == Extent::narrow || (extent == Extent::wide && last)) {
    StarPatch own = patch;
    own.frame = frame_of(patch.sky, middle);
    own.sky = in_frame(patch.sky, own.frame);
    own.halvings = search_halvings + (deepest_patch - depth) / 2;
    PatchMeasures measures;
    measure_patch({&own.sky, chart_, own.gamma_turns, own.s, own.width_turns, own.height, wanted.light.energy(),
                   wanted.light.observer(), &measures});
    const Stretching stretching = stretching_of(measures, own);
    own.shape = stretching.folded ? PatchShape::folded : measures.regular ? PatchShape::regular : PatchShape::bent;
    own.error = stretching.folded ? static_cast<float>(exactness_.fold_error) : 0.0F;
    const SkyFrustum frustum = frustum_of(own.sky, own.frame, static_cast<double>(own.error));
    own.light = wanted.light.light_in(measures.brightening, measures.frequency_ratio);
    own.seen = measures.seen;
    // Chords are shorter than angles, and sides may bulge between the places that were asked.
    own.seen_radius = 1.6F * measures.seen_radius;
    own.most_camera = 1.1F * measures.greatest_camera * own.width_turns * own.height;
    own.brighter = most_brighter(patch.brighter, own.shape);
    own.magnification = stretching.magnification * (stretching.folded ? 1.0F : own.brighter);
    if (wanted.field.count_from(floor_of(own)) == 0) {
      return;
    }
    if (last || is_done(wanted, own, frustum)) {
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
