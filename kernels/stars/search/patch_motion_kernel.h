#pragma once

#include "kernels/core/arithmetic.h"
#include "kernels/core/lanes.h"
#include "kernels/stars/search/patch_motion.h"

namespace ergodome::inline ERGO_TARGET {

//! Moves a patch. Index i is patch i, with control points as lanes.
template <class T>
struct MovePatch {
  static constexpr int lanes = RealTraits<T>::lane_count;
  static constexpr int points = 16;

  const PatchMotionBatch& batch;

  ERGO_HD void operator()(int index) const {
    const StarPatch& from = batch.from[index];
    StarPatch& to = batch.moved[index];
    to = from;
    to.frame = {turned(from.frame.first), turned(from.frame.second), turned(from.frame.axis)};
    const PatchMotion& motion = batch.motions[index];
    const float along_r_r = batch.along_r * batch.along_r;
    const float along_r_theta = batch.along_r * batch.along_theta;
    Range range{T(largest), T(-largest), T(largest), T(-largest), T(largest)};
    for (int i = 0; i < points; i += lanes) {
      const auto moved = [&](float(BezierPatch::*part)[16]) {
        const T value = load_lanes<T>(from.sky.*part, i, points) +
                        batch.along_r * load_lanes<T>(motion.along_r.*part, i, points) +
                        batch.along_theta * load_lanes<T>(motion.along_theta.*part, i, points) +
                        along_r_r * load_lanes<T>(motion.along_r_r.*part, i, points) +
                        along_r_theta * load_lanes<T>(motion.along_r_theta.*part, i, points);
        store_lanes(to.sky.*part, i, points, value);
        return value;
      };
      add(moved(&BezierPatch::x), moved(&BezierPatch::y), moved(&BezierPatch::z), range);
    }
    enclose(range, to);
  }

 private:
  static constexpr float largest = 3e38F;
  //! Control points with a smaller z may be so far from the axis that planes do not enclose them.
  static constexpr float min_z = 1e-3F;

  //! Ranges of control points in gnomonic projection about the patch's axis, and their smallest z.
  struct Range {
    T low_x, high_x;
    T low_y, high_y;
    T low_z;
  };

  [[nodiscard]] ERGO_HD Vector3<double> turned(const Vector3<double>& v) const {
    const double(&m)[3][3] = batch.turn;
    return {m[0][0] * v.x + m[0][1] * v.y + m[0][2] * v.z, m[1][0] * v.x + m[1][1] * v.y + m[1][2] * v.z,
            m[2][0] * v.x + m[2][1] * v.y + m[2][2] * v.z};
  }

  ERGO_HD static void add(const T& x, const T& y, const T& z, Range& range) {
    const T inverse = T(1.0F) / z;
    const T a = x * inverse;
    const T b = y * inverse;
    range = {minimum(range.low_x, a), maximum(range.high_x, a), minimum(range.low_y, b), maximum(range.high_y, b),
             minimum(range.low_z, z)};
  }

  ERGO_HD static float highest(const T& value) {
    // Halves the number of values in each step, so that compilers use registers.
    float values[lanes];
    store_lanes(values, 0, lanes, value);
    ERGO_UNROLL
    for (int half = lanes / 2; half > 0; half /= 2) {
      for (int i = 0; i < half; ++i) {
        values[i] = maximum(values[i], values[i + half]);
      }
    }
    return values[0];
  }

  //! Replaces the planes that enclose a patch at all positions of its cell by those that enclose it
  //! at this position, between which there are fewer stars.
  ERGO_HD static void enclose(const Range& range, StarPatch& patch) {
    if (!(-highest(-range.low_z) > min_z)) {
      return;
    }
    const float low[2] = {-highest(-range.low_x), -highest(-range.low_y)};
    const float high[2] = {highest(range.high_x), highest(range.high_y)};
    const Vector3<double>* const way[2] = {&patch.frame.first, &patch.frame.second};
    for (int axis = 0; axis < 2; ++axis) {
      const float wider = part_slack * (high[axis] - low[axis]) + min_part_slack + patch.error;
      set_plane(patch.frame.axis, *way[axis], 1.0, low[axis] - wider, patch.part.inward[2 * axis]);
      set_plane(patch.frame.axis, *way[axis], -1.0, high[axis] + wider, patch.part.inward[2 * axis + 1]);
    }
  }

  //! Sets the normal of the plane through `way` = `position` in gnomonic projection; its inside is
  //! where `sign` * `way` is larger. Its length does not matter.
  ERGO_HD static void set_plane(const Vector3<double>& axis, const Vector3<double>& way, double sign, float position,
                                float (&normal)[3]) {
    const Vector3<double> inward = sign * (way - static_cast<double>(position) * axis);
    normal[0] = static_cast<float>(inward.x);
    normal[1] = static_cast<float>(inward.y);
    normal[2] = static_cast<float>(inward.z);
  }
};

template <class T, class Action>
void dispatch(const PatchMotionBatch& batch, const Action& action) {
  action(MovePatch<T>{batch});
}

}  // namespace ergodome::inline ERGO_TARGET
