#pragma once

#include "kernels/core/vector3.h"
#include "kernels/lens/lens_grid.h"

namespace ergodome {

//! A bicubic patch by its control points, row after row along v: what it is within [0, 1]² lies in their convex hull, cones included.
struct BezierPatch {
  float x[16];
  float y[16];
  float z[16];
};

//! The patch of a leaf of a lens grid: the sky direction over (u, v) along (γ, s), before it is normalized.
BezierPatch bezier_patch(const LensGrid& grid, int leaf, float width_turns, float height);

//! The parts of a patch below and above the middle of u (axis 0) or v (axis 1).
void split(const BezierPatch& patch, int axis, BezierPatch& first, BezierPatch& second);

//! Two of a patch's coordinates, in some plane.
struct PlanePatch {
  float p[16];
  float q[16];
};

//! Whether the control points leave room for p = q = 0 within the patch.
bool may_hold_origin(const PlanePatch& patch);

//! A value with its derivatives along u and v.
struct PlaneValue {
  float p, q;
  float p_u, q_u;
  float p_v, q_v;
};

//! The patch at (u, v), which may lie outside [0, 1]².
PlaneValue evaluate(const PlanePatch& patch, float u, float v);

void split(const PlanePatch& patch, int axis, PlanePatch& first, PlanePatch& second);

//! Newton's method for p = q = 0 from (u, v). False where it runs away or does not settle.
bool find_origin(const PlanePatch& patch, float& u, float& v);

}  // namespace ergodome
