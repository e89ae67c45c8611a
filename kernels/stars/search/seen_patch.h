#pragma once

#include "kernels/core/lanes.h"
#include "kernels/stars/search/bezier_patch.h"
#include "kernels/stars/search/seen_parts.h"

namespace ergodome::inline ERGO_TARGET {

//! Patches as stars see them, one in each lane: p = q = 0 at the star.
template <class T>
struct SeenPatch {
  T p[16];
  T q[16];
};

//! Parts of patches as stars see them, one in each lane, with their other channels.
template <class T>
struct SeenPart {
  SeenPatch<T> patch;
  T u, v;
  T size_u, size_v;
  T pair, error, halvings;
};

//! Loads the parts first, first + 1, ... Lists are padded, and lanes past the end are undefined.
template <class T>
ERGO_HD SeenPart<T> load_parts(const SeenParts& parts, int first) {
  const auto load = [&](int channel) {
    return load_lanes<T>(parts.at + static_cast<long>(channel) * parts.room, first, first + RealTraits<T>::lane_count);
  };
  SeenPart<T> part;
  ERGO_UNROLL
  for (int i = 0; i < 16; ++i) {
    part.patch.p[i] = load(part_p + i);
    part.patch.q[i] = load(part_q + i);
  }
  part.u = load(part_u);
  part.v = load(part_v);
  part.size_u = load(part_size_u);
  part.size_v = load(part_size_v);
  part.pair = load(part_pair);
  part.error = load(part_error);
  part.halvings = load(part_halvings);
  return part;
}

//! Calls store(channel, value) for each channel of parts.
template <class T, class Store>
ERGO_HD void store_parts(const SeenPart<T>& part, const Store& store) {
  ERGO_UNROLL
  for (int i = 0; i < 16; ++i) {
    store(part_p + i, part.patch.p[i]);
    store(part_q + i, part.patch.q[i]);
  }
  store(part_u, part.u);
  store(part_v, part.v);
  store(part_size_u, part.size_u);
  store(part_size_v, part.size_v);
  store(part_pair, part.pair);
  store(part_error, part.error);
  store(part_halvings, part.halvings);
}

//! Evaluates patches at (u, v), which may lie outside [0, 1]². The patches are already relative to
//! their stars.
template <class T>
ERGO_HD PlaneValue<T> seen_at(const SeenPatch<T>& patch, const T& u, const T& v) {
  T along_u[4];
  T slope_u[4];
  T along_v[4];
  T slope_v[4];
  detail::bernstein(u, along_u, slope_u);
  detail::bernstein(v, along_v, slope_v);
  const detail::FormValue<T> p = detail::form_at(patch.p, along_u, slope_u, along_v, slope_v);
  const detail::FormValue<T> q = detail::form_at(patch.q, along_u, slope_u, along_v, slope_v);
  return {p.value, q.value, p.by_u, q.by_u, p.by_v, q.by_v};
}

//! Returns the lanes whose patch has a nearly constant Jacobian. Such a patch is one to one, and
//! Newton's method from its middle converges to the star's image.
template <class T>
ERGO_HD MaskOf<T> is_regular(const SeenPatch<T>& patch) {
  const T half(0.5F);
  const PlaneValue<T> middle = seen_at(patch, half, half);
  const T scale = T(3.0F) / determinant(middle);
  // J⁻¹ times the control points of the derivative by u or v, minus the unit vector that it equals
  // in an affine map.
  const auto change = [&](int from, int to, float unit_u, float unit_v) {
    const T dp = patch.p[to] - patch.p[from];
    const T dq = patch.q[to] - patch.q[from];
    return maximum(absolute((middle.q_v * dp - middle.p_v * dq) * scale - T(unit_u)),
                   absolute((middle.p_u * dq - middle.q_u * dp) * scale - T(unit_v)));
  };
  T along_u(0.0F);
  T along_v(0.0F);
  ERGO_UNROLL
  for (int i = 0; i < 12; ++i) {
    const int in_row = i / 3 * 4 + i % 3;
    along_u = maximum(along_u, change(in_row, in_row + 1, 1.0F, 0.0F));
    along_v = maximum(along_v, change(i, i + 4, 0.0F, 1.0F));
  }
  return along_u + along_v < T(max_regular_change);
}

}  // namespace ergodome::inline ERGO_TARGET
