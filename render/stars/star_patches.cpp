#include "render/stars/star_patches.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ergodome {

namespace {

//! Halvings of a leaf at the most, for regular patches; next to a critical curve no patch is regular.
constexpr int deepest_patch = 6;
//! cos of the widest cone of a patch: wide ones would hold stars that they do not see.
constexpr double widest_cosine = 0.94;
//! How far J may be from a patch's middle J, as a part of it, for Newton's method to be safe.
constexpr float most_change = 0.6F;
//! Next to a critical curve images are as bright as one likes, but seldom: M-fold in a patch of solid angle w on the camera's sky are
//! those of w / M of the sky at the most. What less of the sky than this would show is not looked for.
constexpr float neglected_sky = 1e-9F;
//! What an image may be brighter than the grid makes it out to be.
constexpr float most_grid_error = 2.0F;

Vector3<double> point(const BezierPatch& patch, int i) {
  return {static_cast<double>(patch.x[i]), static_cast<double>(patch.y[i]), static_cast<double>(patch.z[i])};
}

Vector3<double> normalized(const Vector3<double>& v) { return (1.0 / std::sqrt(dot(v, v))) * v; }

//! Two directions across another.
void across(const Vector3<double>& axis, Vector3<double>& first, Vector3<double>& second) {
  const Vector3<double> helper =
      std::abs(axis.z) < 0.9 ? Vector3<double>{0.0, 0.0, 1.0} : Vector3<double>{1.0, 0.0, 0.0};
  first = normalized(cross(helper, axis));
  second = cross(axis, first);
}

PlanePatch in_plane(const BezierPatch& patch, const Vector3<double>& first, const Vector3<double>& second) {
  const auto e = [](const Vector3<double>& v) {
    return Vector3<float>{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
  };
  const Vector3<float> a = e(first);
  const Vector3<float> b = e(second);
  PlanePatch plane{};
  for (int i = 0; i < 16; ++i) {
    plane.p[i] = patch.x[i] * a.x + patch.y[i] * a.y + patch.z[i] * a.z;
    plane.q[i] = patch.x[i] * b.x + patch.y[i] * b.y + patch.z[i] * b.z;
  }
  return plane;
}

//! The cone that holds a patch; false where the patch is no part of the sky (nodes without light) or spans half of it.
bool set_cone(StarPatch& patch) {
  const Vector3<double> sum = point(patch.sky, 0) + point(patch.sky, 3) + point(patch.sky, 12) + point(patch.sky, 15);
  if (!(dot(sum, sum) > 1e-6)) {
    return false;
  }
  patch.axis = normalized(sum);
  double cosine = 1.0;
  for (int i = 0; i < 16; ++i) {
    const Vector3<double> p = point(patch.sky, i);
    const double square = dot(p, p);
    cosine = std::min(cosine, square > 1e-6 ? dot(p, patch.axis) / std::sqrt(square) : -1.0);
  }
  patch.cosine = cosine - 1e-6;
  patch.sine = std::sqrt(std::max(0.0, 1.0 - patch.cosine * patch.cosine));
  return cosine > 0.1;
}

//! A patch as its middle's tangent plane sees it.
PlanePatch tangent_patch(const StarPatch& patch) {
  Vector3<double> first;
  Vector3<double> second;
  across(patch.axis, first, second);
  return in_plane(patch.sky, first, second);
}

float determinant(const PlaneValue& f) { return f.p_u * f.q_v - f.p_v * f.q_u; }

//! Whether the Jacobian is nearly the same all over: then the patch is one to one, and Newton's method ends at the image.
bool is_regular(const PlanePatch& plane) {
  const PlaneValue middle = evaluate(plane, 0.5F, 0.5F);
  const float inverse = 1.0F / determinant(middle);
  // J⁻¹ times the control points of a derivative, less the unit vector that it should be.
  const auto change = [&](int from, int to, float unit_u, float unit_v) {
    const float dp = 3.0F * (plane.p[to] - plane.p[from]);
    const float dq = 3.0F * (plane.q[to] - plane.q[from]);
    return std::max(std::abs((middle.q_v * dp - middle.p_v * dq) * inverse - unit_u),
                    std::abs((middle.p_u * dq - middle.q_u * dp) * inverse - unit_v));
  };
  float along_u = 0.0F;
  float along_v = 0.0F;
  for (int i = 0; i < 16; ++i) {
    along_u = i % 4 < 3 ? std::max(along_u, change(i, i + 1, 1.0F, 0.0F)) : along_u;
    along_v = i < 12 ? std::max(along_v, change(i, i + 4, 0.0F, 1.0F)) : along_v;
  }
  return along_u + along_v < most_change;
}

//! The camera's solid angle per area of the chart at a place in a patch.
float camera_rate(const LensChart& chart, const StarPatch& patch, float u, float v) {
  const ChartStretch<float> stretch =
      chart_stretch(chart, patch.gamma_turns + u * patch.width_turns, patch.s + v * patch.height);
  return 6.2831853F * std::abs(std::sin(stretch.alpha.value) * stretch.alpha.along_y);
}

//! The sky's, with its sign.
float sky_rate(const StarPatch& patch, const PlanePatch& plane, float u, float v) {
  return determinant(evaluate(plane, u, v)) / (patch.width_turns * patch.height);
}

//! The camera's solid angle over the sky's.
float magnification_at(const LensChart& chart, const StarPatch& patch, const PlanePatch& plane, float u, float v) {
  return camera_rate(chart, patch, u, v) / std::max(std::abs(sky_rate(patch, plane, u, v)), 1e-30F);
}

//! What a patch does to solid angles.
struct Stretching {
  bool folded;          //!< turned over in parts
  float magnification;  //!< greatest ratio of the camera's to the sky's, with a margin for the gaps between samples
  float solid_angle;    //!< of the patch on the camera's sky [sr]
};

Stretching stretching_of(const LensChart& chart, const StarPatch& patch, const PlanePatch& plane) {
  constexpr int steps = 4;
  float lowest = std::numeric_limits<float>::infinity();
  float highest = -lowest;
  float greatest = 0.0F;
  float camera_sum = 0.0F;
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; j <= steps; ++j) {
      const float u = static_cast<float>(i) / steps;
      const float v = static_cast<float>(j) / steps;
      const float sky = sky_rate(patch, plane, u, v);
      lowest = std::min(lowest, sky);
      highest = std::max(highest, sky);
      const float camera = camera_rate(chart, patch, u, v);
      camera_sum += camera;
      greatest = std::max(greatest, camera / std::max(std::abs(sky), 1e-30F));
    }
  }
  const bool folded = !(lowest * highest > 0.0F);
  constexpr float samples = (steps + 1) * (steps + 1);
  return {folded, 2.0F * greatest, patch.width_turns * patch.height * camera_sum / samples};
}

//! The axis along which a patch is longer on the sky.
int longer_axis(const BezierPatch& patch) {
  const auto distance = [&](int i, int j) {
    const Vector3<double> d = point(patch, i) - point(patch, j);
    return dot(d, d);
  };
  return distance(0, 3) + distance(12, 15) >= distance(0, 12) + distance(3, 15) ? 0 : 1;
}

}  // namespace

StarPatches::StarPatches(const LensStation& station, const ImageLight& light, float least_gain)
    : edge_(station.edge), chart_(grid_view(station).chart), mirrored_(station.mirrored) {
  chart_.edge.polar_angle = edge_.data();
  const LensGrid grid = grid_view(station);
  const std::vector<LeafBox> boxes = leaf_boxes(station);
  patches_.reserve(2 * boxes.size());
  for (std::size_t leaf = 0; leaf < boxes.size(); ++leaf) {
    StarPatch patch{};
    patch.gamma_turns = static_cast<float>(boxes[leaf].gamma_turns);
    patch.s = static_cast<float>(boxes[leaf].s);
    patch.width_turns = static_cast<float>(boxes[leaf].width_turns);
    patch.height = static_cast<float>(boxes[leaf].height);
    patch.sky = bezier_patch(grid, static_cast<int>(leaf), patch.width_turns, patch.height);
    add_patch(light, least_gain, patch, 0);
  }
}

void StarPatches::add_patch(const ImageLight& light, float least_gain, StarPatch patch, int depth) {
  const bool cone = set_cone(patch);
  const bool narrow = cone && patch.cosine > widest_cosine;
  const bool last = depth >= deepest_patch;
  if (narrow || (cone && last)) {
    const PlanePatch plane = tangent_patch(patch);
    const Stretching stretching = stretching_of(chart_, patch, plane);
    patch.shape = stretching.folded ? PatchShape::folded : is_regular(plane) ? PatchShape::regular : PatchShape::bent;
    patch.magnification = stretching.folded ? stretching.solid_angle / neglected_sky : stretching.magnification;
    light.see(patch);
    if (!(light.greatest_gain(patch, patch.magnification) >= least_gain)) {
      return;
    }
    if (patch.shape != PatchShape::folded || last) {
      patches_.push_back(patch);
      return;
    }
  } else if (last) {
    return;
  }
  const int axis = longer_axis(patch.sky);
  StarPatch second = patch;
  split(patch.sky, axis, patch.sky, second.sky);
  float& extent = axis == 0 ? patch.width_turns : patch.height;
  extent *= 0.5F;
  (axis == 0 ? second.width_turns : second.height) = extent;
  (axis == 0 ? second.gamma_turns : second.s) += extent;
  add_patch(light, least_gain, patch, depth + 1);
  add_patch(light, least_gain, second, depth + 1);
}

void StarPatches::search(const StarPatch& patch, const StarField& field, const ImageLight& light, double phi,
                         bool mirrored, float faintest, std::vector<RoughImage>& found) const {
  const double side = mirrored ? -1.0 : 1.0;
  const double sine_phi = std::sin(phi);
  const double cosine_phi = std::cos(phi);
  // Patches belong to a camera at φ = 0, and to one half of a mirrored sky.
  const Vector3<double> axis = {cosine_phi * patch.axis.x - sine_phi * patch.axis.y,
                                sine_phi * patch.axis.x + cosine_phi * patch.axis.y, side * patch.axis.z};
  const float least = faintest / light.greatest_gain(patch, patch.magnification);
  std::vector<Root> roots;
  field.search(axis, patch.sine, patch.cosine, least, [&](int number) {
    const FieldStar& star = field.stars()[static_cast<std::size_t>(number)];
    if (!(star.illuminance >= least)) {
      return false;
    }
    const Vector3<double>& d = star.direction;
    if (dot(d, axis) < patch.cosine || !(star.illuminance * light.gain(patch, patch.magnification, star) >= faintest)) {
      return true;
    }
    const Vector3<double> own = {cosine_phi * d.x + sine_phi * d.y, cosine_phi * d.y - sine_phi * d.x, side * d.z};
    Vector3<double> first;
    Vector3<double> second;
    across(own, first, second);
    const PlanePatch plane = in_plane(patch.sky, first, second);
    roots.clear();
    find_roots(plane, patch.shape, roots);
    for (const Root& root : roots) {
      const float magnification = magnification_at(chart_, patch, plane, root.u, root.v);
      if (star.illuminance * light.gain(patch, most_grid_error * magnification, star) >= faintest) {
        const float gamma = patch.gamma_turns + root.u * patch.width_turns;
        const float seen = mirrored ? 1.0F - gamma : gamma;
        found.push_back({number, seen - std::floor(seen), patch.s + root.v * patch.height});
      }
    }
    return true;
  });
}

}  // namespace ergodome
