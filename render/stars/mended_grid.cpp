#include "render/stars/mended_grid.h"

#include <algorithm>
#include <cmath>

#include "render/lens/grid_tracer.h"

namespace ergodome {

namespace {

constexpr int floats_a_leaf = 2 * checks_a_cell;
//! Steps that change the Jacobian [parts of a leaf], and how many of them are made.
constexpr float short_step = 2e-4F;
constexpr int most_steps = 3;
constexpr float unknown = 1e30F;
//! An image moves no farther.
constexpr float longest_way = 0.1F;

//! (t (1 - t))², 1 in the middle, and its derivative.
struct Quartic {
  float value, slope;
};

Quartic quartic(float t) {
  const float both = t * (1.0F - t);
  return {16.0F * both * both, 32.0F * both * (1.0F - 2.0F * t)};
}

Vector3<float> xyz(const Quad& from, float scale) {
  return {scale * quad_part(from, 0), scale * quad_part(from, 1), scale * quad_part(from, 2)};
}

//! What a patch says at a place: the sky, and what it changes by along the leaf's sides.
struct PatchPlane {
  Vector3<float> sky;
  Vector3<float> along_u;
  Vector3<float> along_v;

  //! Area of the sky over that of the unit square.
  [[nodiscard]] float area() const { return dot(sky, cross(along_u, along_v)); }
};

PatchPlane plane_of(const PatchValue& patch, const LeafBox& box) {
  const Vector3<float> sum = xyz(patch.sky, 1.0F);
  const float inverse = 1.0F / std::sqrt(dot(sum, sum));
  return {inverse * sum, xyz(patch.along_gamma, inverse * static_cast<float>(box.width_turns)),
          xyz(patch.along_s, inverse * static_cast<float>(box.height))};
}

}  // namespace

MendedGrid::MendedGrid(const LensStation& station)
    : boxes_(leaf_boxes(station)),
      leaves_(station.leaves),
      nodes_(station.traced_nodes),
      checks_(station.leaf_displacements) {}

MendedGrid::Displacement MendedGrid::displacement(int leaf, float u, float v) const {
  const float* const gamma = checks_.data() + static_cast<std::ptrdiff_t>(floats_a_leaf) * leaf;
  const float* const s = gamma + checks_a_cell;
  const Quartic along = quartic(u);
  const Quartic across = quartic(v);
  // Checks 1 and 2 are the middles of the sides at s0 and s1, 3 and 4 of those at γ0 and γ1.
  const auto mixed = [](float a, float b, float t) { return a + t * (b - a); };
  const auto at = [&](const float* c) {
    return along.value * mixed(c[1], c[2], v) + across.value * mixed(c[3], c[4], u);
  };
  return {at(gamma), at(s),
          along.slope * mixed(gamma[1], gamma[2], v) + across.value * (gamma[4] - gamma[3]) +
              along.value * (s[2] - s[1]) + across.slope * mixed(s[3], s[4], u)};
}

LeafErrors MendedGrid::errors(int leaf) const {
  if (checks_.empty()) {
    return {unknown, unknown};
  }
  const float* const gamma = checks_.data() + static_cast<std::ptrdiff_t>(floats_a_leaf) * leaf;
  const float* const s = gamma + checks_a_cell;
  LeafErrors errors{0.0F, 0.0F};
  for (int check = 0; check < checks_a_cell; ++check) {
    const bool inside = check == 0 || check == checks_a_cell - 1;
    const float told = std::abs(gamma[check]) + std::abs(s[check]);
    errors.told = std::max(errors.told, inside ? inner_share * told : told);
    if (inside) {
      const float place = check == 0 ? inner_check : 1.0F - inner_check;
      const Displacement said = displacement(leaf, place, place);
      errors.left =
          std::max(errors.left, std::abs(gamma[check] - said.along_gamma) + std::abs(s[check] - said.along_s));
    }
  }
  return errors;
}

bool MendedGrid::mend(int leaf, const Vector3<double>& star, ChartImage& image) const {
  const LeafBox& box = boxes_[static_cast<std::size_t>(leaf)];
  const auto width = static_cast<float>(box.width_turns);
  const auto height = static_cast<float>(box.height);
  const auto gamma_0 = static_cast<float>(box.gamma_turns);
  const auto s_0 = static_cast<float>(box.s);
  const float start[2] = {(image.gamma_turns - gamma_0) / width, (image.s - s_0) / height};
  const Vector3<float> there = {static_cast<float>(star.x), static_cast<float>(star.y), static_cast<float>(star.z)};
  float u = start[0];
  float v = start[1];
  float area = 0.0F;
  // The patch of the search agrees with its neighbours; this one is that of the rays.
  for (int step = 0; step < most_steps; ++step) {
    const PatchPlane patch = plane_of(
        patch_value(nodes_.data(), leaves_.data() + 4 * static_cast<std::ptrdiff_t>(leaf), u, v, width, height), box);
    area = patch.area();
    const Vector3<float> miss = there - patch.sky;
    const float du = dot(patch.sky, cross(miss, patch.along_v)) / area;
    const float dv = dot(patch.sky, cross(patch.along_u, miss)) / area;
    u += du;
    v += dv;
    if (std::abs(du) + std::abs(dv) < short_step) {
      break;
    }
  }
  const Displacement by = displacement(leaf, u, v);
  u += by.along_gamma;
  v += by.along_s;
  // False for what is not a number.
  if (!(std::abs(u - start[0]) + std::abs(v - start[1]) < longest_way)) {
    return false;
  }
  image = {gamma_0 + u * width, s_0 + v * height, -area * (1.0F - by.spread) / (width * height)};
  return true;
}

}  // namespace ergodome
