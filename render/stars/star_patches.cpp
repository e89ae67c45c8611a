#include "render/stars/star_patches.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/launch/parallel_for.h"

namespace ergodome {

namespace {

//! Halvings of a leaf at the most, for regular patches; next to a critical curve no patch is regular.
constexpr int deepest_patch = 12;
//! Stars that a patch which is not regular may have to try before it is halved.
constexpr double few_stars = 12.0;
//! Halvings in search of images that stand for those that a patch was spared.
constexpr int search_halvings = 8;
constexpr int leaves_a_chunk = 16;
//! cos of the widest cone of a patch: wide ones would hold stars that they do not see.
constexpr double widest_cosine = 0.94;
//! Next to a critical curve images are as bright as one likes, but seldom: M-fold in a patch of solid angle w on the camera's sky are
//! those of w / M of the sky at the most. What less of the sky than this would show is not looked for.
constexpr float neglected_sky = 1e-8F;

Vector3<double> normalized(const Vector3<double>& v) { return (1.0 / std::sqrt(dot(v, v))) * v; }

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

//! A patch in its middle's tangent plane.
PlaneValue<float> tangent_value(const BezierPatch& patch, float u, float v) {
  return seen_from(patch, 0.0F, 0.0F, u, v);
}

//! The camera's solid angle per area of the chart at a place in a patch.
float camera_rate(const LensChart& chart, const StarPatch& patch, float u, float v) {
  const ChartStretch<float> stretch =
      chart_stretch(chart, patch.gamma_turns + u * patch.width_turns, patch.s + v * patch.height);
  return 6.2831853F * std::abs(std::sin(stretch.alpha.value) * stretch.alpha.along_y);
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

Stretching stretching_of(const LensChart& chart, const StarPatch& patch) {
  const float chart_area = patch.width_turns * patch.height;
  constexpr int steps = 4;
  float lowest = std::numeric_limits<float>::infinity();
  float highest = -lowest;
  float greatest = 0.0F;
  float camera_most = 0.0F;
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; j <= steps; ++j) {
      const float u = static_cast<float>(i) / steps;
      const float v = static_cast<float>(j) / steps;
      const float sky = determinant(tangent_value(patch.sky, u, v)) / chart_area;
      lowest = std::min(lowest, sky);
      highest = std::max(highest, sky);
      const float camera = camera_rate(chart, patch, u, v);
      camera_most = std::max(camera_most, camera);
      greatest = std::max(greatest, camera / std::max(std::abs(sky), 1e-30F));
    }
  }
  constexpr float between_samples = 2.0F;
  const float sky_range = highest - lowest;
  // A fold may hide between samples.
  if (lowest > 0.05F * sky_range || highest < -0.05F * sky_range) {
    return {false, between_samples * greatest};
  }
  return {true, folded_magnification(camera_most, sky_range, chart_area)};
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
                         float error)
    : edge_(station.edge),
      chart_(grid_view(station).chart),
      mirrored_(station.mirrored),
      faintest_(faintest),
      error_(error) {
  chart_.edge.polar_angle = edge_.data();
  const LensGrid grid = grid_view(station);
  const std::vector<LeafBox> boxes = leaf_boxes(station);
  const int leaves = static_cast<int>(boxes.size());
  std::vector<std::vector<StarPatch>> parts(static_cast<std::size_t>((leaves + leaves_a_chunk - 1) / leaves_a_chunk));
  parallel_for(static_cast<int>(parts.size()), 1, [&](int begin, int end) {
    for (int leaf = begin * leaves_a_chunk; leaf < std::min(end * leaves_a_chunk, leaves); ++leaf) {
      const LeafBox& box = boxes[static_cast<std::size_t>(leaf)];
      StarPatch patch{};
      patch.gamma_turns = static_cast<float>(box.gamma_turns);
      patch.s = static_cast<float>(box.s);
      patch.width_turns = static_cast<float>(box.width_turns);
      patch.height = static_cast<float>(box.height);
      patch.sky = bezier_patch(grid, leaf, patch.width_turns, patch.height);
      add_patch({field, light}, patch, 0, parts[static_cast<std::size_t>(leaf / leaves_a_chunk)]);
    }
  });
  for (const std::vector<StarPatch>& part : parts) {
    patches_.insert(patches_.end(), part.begin(), part.end());
  }
}

bool StarPatches::is_done(const Wanted& wanted, const StarPatch& patch) const {
  const double share = solid_angle(patch.frustum) / (4.0 * 3.14159265358979323846);
  const double stars = static_cast<double>(wanted.field.count_from(faintest_ / patch.gain)) * std::min(share, 1.0);
  return patch.shape == PatchShape::regular || stars <= few_stars;
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
    const Stretching stretching = stretching_of(chart_, own);
    own.shape = stretching.folded ? PatchShape::folded : is_regular(own.sky) ? PatchShape::regular : PatchShape::bent;
    own.error = stretching.folded ? error_ : 0.0F;
    own.frustum = frustum_of(own.sky, own.frame, static_cast<double>(own.error));
    wanted.light.see(own);
    own.gain = wanted.light.greatest_gain(own, stretching.magnification);
    if (wanted.field.count_from(faintest_ / own.gain) == 0) {
      return;
    }
    if (last || is_done(wanted, own)) {
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

float StarPatches::camera_solid_angle(const StarPatch& patch, float u, float v) const {
  return camera_rate(chart_, patch, u, v) * patch.width_turns * patch.height;
}

}  // namespace ergodome
