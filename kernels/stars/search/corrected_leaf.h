#pragma once

#include <cmath>

#include "kernels/core/quad.h"
#include "kernels/core/vector3.h"
#include "kernels/lens/grid_build.h"

// Corrects images of stars in leaves of a lens grid by the displacements that traced rays have
// measured there.
namespace ergodome {

//! An image of a star in a lens chart.
struct ChartImage {
  float gamma_turns;
  float s;
  //! Solid angle of the sky per area of the chart; negative for inverted parity [sr/turn].
  float sky;
};

//! Leaves of a lens grid with the results of their checks; see CorrectedGrid
//! (render/passes/stars/search/corrected_grid.h).
struct CorrectedLeaves {
  //! Four per leaf: its corner in the chart, γ [turns] and s, its width and its height.
  const float* boxes;
  const int* leaves;   //!< four node indices per leaf, as LensGrid::leaves
  const float* nodes;  //!< nodes as in LensGrid, with the values of traced rays
  //! For each leaf: the displacements of traced rays from the grid at its checks, along γ, then
  //! along s, in fractions of the leaf's sides; nullptr: unknown.
  const float* checks;
};

//! A displacement of an image within a leaf, in fractions of the leaf's sides.
struct LeafDisplacement {
  float along_gamma;
  float along_s;
  float spread;  //!< divergence of the displacement
};

inline namespace ERGO_TARGET {

namespace detail {
inline constexpr int floats_of_checks = 2 * checks_a_cell;

//! (t (1 - t))², scaled to 1 in the middle, and its derivative by t.
struct Quartic {
  float value, slope;
};

ERGO_HD Quartic quartic(float t) {
  const float both = t * (1.0F - t);
  return {16.0F * both * both, 32.0F * both * (1.0F - 2.0F * t)};
}

ERGO_HD float mixed(float a, float b, float t) { return a + t * (b - a); }

//! Interpolates one component of the displacement, along γ or s, from its values `c` at the checks.
//! Checks 1 and 2 are the midpoints of the sides at s0 and s1, 3 and 4 those at γ0 and γ1.
ERGO_HD float blended(const float* c, const Quartic& along, const Quartic& across, float u, float v) {
  return along.value * mixed(c[1], c[2], v) + across.value * mixed(c[3], c[4], u);
}

ERGO_HD Vector3<float> scaled_xyz(const Quad& from, float scale) {
  return {scale * quad_part(from, 0), scale * quad_part(from, 1), scale * quad_part(from, 2)};
}
}  // namespace detail

ERGO_HD LeafDisplacement leaf_displacement(const CorrectedLeaves& grid, int leaf, float u, float v) {
  using detail::mixed;
  const float* const gamma = grid.checks + static_cast<long>(detail::floats_of_checks) * leaf;
  const float* const s = gamma + checks_a_cell;
  const detail::Quartic along = detail::quartic(u);
  const detail::Quartic across = detail::quartic(v);
  return {detail::blended(gamma, along, across, u, v), detail::blended(s, along, across, u, v),
          along.slope * mixed(gamma[1], gamma[2], v) + across.value * (gamma[4] - gamma[3]) +
              along.value * (s[2] - s[1]) + across.slope * mixed(s[3], s[4], u)};
}

//! Moves an image of the star at the unit vector `star` from its approximate position in a leaf's
//! patch to where traced rays have it. Returns false, and changes nothing, if it is too far away
//! for a first-order correction.
ERGO_HD bool correct_image(const CorrectedLeaves& grid, int leaf, const Vector3<float>& star, ChartImage& image) {
  // Newton's method ends after a step shorter than short_step [fractions of a leaf], which hardly
  // changes the Jacobian, or after max_steps steps.
  constexpr float short_step = 2e-4F;
  constexpr int max_steps = 3;
  // Maximum displacement of an image by the correction [fractions of a leaf].
  constexpr float longest_way = 0.1F;
  const float* const box = grid.boxes + 4 * static_cast<long>(leaf);
  const float width = box[2];
  const float height = box[3];
  const float start[2] = {(image.gamma_turns - box[0]) / width, (image.s - box[1]) / height};
  float u = start[0];
  float v = start[1];
  float area = 0.0F;
  // The search used a patch that agrees with its neighbors. Newton's method moves the image to its
  // position in the patch of the traced rays.
  for (int step = 0; step < max_steps; ++step) {
    const PatchValue patch = patch_value(grid.nodes, grid.leaves + 4 * static_cast<long>(leaf), u, v, width, height);
    const Vector3<float> sum = detail::scaled_xyz(patch.sky, 1.0F);
    const float inverse = 1.0F / ::sqrtf(dot(sum, sum));
    const Vector3<float> sky = inverse * sum;
    const Vector3<float> along_u = detail::scaled_xyz(patch.along_gamma, inverse * width);
    const Vector3<float> along_v = detail::scaled_xyz(patch.along_s, inverse * height);
    area = dot(sky, cross(along_u, along_v));
    const Vector3<float> miss = star - sky;
    const float du = dot(sky, cross(miss, along_v)) / area;
    const float dv = dot(sky, cross(along_u, miss)) / area;
    u += du;
    v += dv;
    if (::fabsf(du) + ::fabsf(dv) < short_step) {
      break;
    }
  }
  const LeafDisplacement by = leaf_displacement(grid, leaf, u, v);
  u += by.along_gamma;
  v += by.along_s;
  // The comparison inside the negation is also false if u or v is NaN; the correction is then
  // refused.
  if (!(::fabsf(u - start[0]) + ::fabsf(v - start[1]) < longest_way)) {
    return false;
  }
  image = {box[0] + u * width, box[1] + v * height, -area * (1.0F - by.spread) / (width * height)};
  return true;
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
