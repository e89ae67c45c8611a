#pragma once

#include "kernels/eyes/flat/eye_line.h"
#include "kernels/eyes/flat/pixel_lines.h"
#include "kernels/objects/look_at_objects_kernel.h"

// Draws objects for an eye of the stereo model `flat`. The sweep of a line of sight is the angle
// between its ends as the head sees them.
namespace ergodome::inline ERGO_TARGET {

//! Finds the objects that lines of sight of an eye of the stereo model `flat` meet: part by part,
//! nearest first, beside rays of the head that all samples of a pixel share.
template <class T, NearParts Parts>
struct ObjectRaysOfHead {
  using D = Dual<T>;
  static constexpr int max_quads = PixelLines::max_lines / quad_size;

  const FlatObjectPixelBatch& batch;

  //! Cuts a pixel into slices along the shadow's edge. The edge is located by the head's ray of the
  //! farthest part of the pixel's line of sight, where light that has gone round the hole comes
  //! from.
  [[nodiscard]] ERGO_HD PixelSlices slice(int at) const {
    const FlatReach& reach = batch.reach[at];
    const double part_w = static_cast<double>(reach.max_w - reach.min_w) / parts_of(reach);
    const EyeLine<double> line = {middle_of_pixel(batch.pixels, at), batch.sight.eye};
    const CameraStation& camera = batch.pixels.objects.camera;
    return slice_pixel(camera, start_near_ray(camera, line.at(static_cast<double>(reach.min_w) + 0.5 * part_w).n));
  }

  ERGO_HD void find(int first, const Vector3<T>* m, int count, SampleHits<T>* met) const {
    // A ray that several lines share is too far from some of them to resolve images thinner than a
    // pixel, so each slice gets its own rays.
    const int together = batch.pixels.pattern == PixelPattern::slices ? 1 : count;
    for (int k = 0; k < count; k += together) {
      trace_lines(first, m + k, together, met + k);
    }
  }

 private:
  static constexpr int lanes = RealTraits<T>::lane_count;

  //! Finds what `count` lines of sight of each pixel, in the directions m, meet. The lines of a
  //! pixel share the head's rays.
  ERGO_HD void trace_lines(int first, const Vector3<T>* m, int count, SampleHits<T>* met) const {
    PixelLines lines[lanes];
    for (int i = 0; i < lanes; ++i) {
      Vector3<double> own[PixelLines::max_lines];
      for (int k = 0; k < count; ++k) {
        own[k] = {lane(m[k].x, i), lane(m[k].y, i), lane(m[k].z, i)};
      }
      const FlatReach& reach = batch.reach[first + i < batch.pixels.count ? first + i : batch.pixels.count - 1];
      const double part = part_of(reach);
      lines[i].begin(batch.sight, reach, part, own, count);
    }
    for (int k = 0; k < count; ++k) {
      for (int i = 0; i < lanes; ++i) {
        met[k].hits[i] = MeshHit{};
      }
      met[k].energy = T(1.0);
      met[k].momentum = T(0.0);
    }
    Vector3<D> n;
    while (true) {
      const MaskOf<T> wanted = next(lines, n);
      if (!any(wanted)) {
        break;
      }
      trace_beside(n, wanted, lines, count, met);
    }
    for (int k = 0; k < count; ++k) {
      for (int i = 0; i < lanes; ++i) {
        if (met[k].hits[i].mesh >= 0) {
          end(lines[i].direction(k), i, met[k]);
        }
      }
    }
  }

  //! Returns the sweep of a pixel's lines of sight: the angle between their ends as the head sees
  //! them [rad].
  [[nodiscard]] ERGO_HD double way_of(const FlatReach& reach) const {
    return static_cast<double>(reach.max_w - reach.min_w) * length_of(batch.sight.eye);
  }

  //! Returns the length of a line of sight that one of the head's rays represents, as the head sees
  //! it [rad]. If the pixel is cut into slices, a line has at most parts_of_slices parts.
  [[nodiscard]] ERGO_HD double part_of(const FlatReach& reach) const {
    const double part = batch.sight.pixel * part_px(static_cast<double>(reach.width));
    return batch.pixels.pattern == PixelPattern::slices ? ::fmax(part, way_of(reach) / (parts_of_slices - 0.5)) : part;
  }
  [[nodiscard]] ERGO_HD int parts_of(const FlatReach& reach) const {
    return 1 + static_cast<int>(way_of(reach) / part_of(reach));
  }

  //! Returns the length of a line of sight that one of the head's rays may represent, as the head
  //! sees it [px]. A neighbor at δ px is off by about ½ δ² times the rate at which the width of a
  //! pixel grows. For that rate the square of the width over r is used [px], since both grow alike
  //! towards a critical curve.
  [[nodiscard]] ERGO_HD double part_px(double width) const {
    constexpr double longest_px = 4.0;
    constexpr double shortest_px = 0.25;
    const double part = 2.0 / PixelLines::corner_reach * ::sqrt(2.0 * batch.sight.tolerance_px / ::fmax(width, 1e-9));
    return ::fmax(shortest_px, ::fmin(longest_px, part));
  }

  //! Moves on to each pixel's next ray. Returns the lanes that have one, and sets their directions,
  //! with derivatives along EyeReference::across and down.
  ERGO_HD static MaskOf<T> next(PixelLines (&lines)[lanes], Vector3<D>& n) {
    T wanted(0.0);
    for (int i = 0; i < lanes; ++i) {
      set_lane(wanted, i, lines[i].next() ? 1.0 : 0.0);
      const EyeReference& own = lines[i].reference();
      const auto set = [i](D& to, double value, double across, double down) {
        set_lane(to.value, i, value);
        set_lane(to.along_x, i, across);
        set_lane(to.along_y, i, down);
      };
      set(n.x, own.n.x, own.across.x, own.down.x);
      set(n.y, own.n.y, own.across.y, own.down.y);
      set(n.z, own.n.z, own.across.z, own.down.z);
    }
    return wanted > T(0.0);
  }

  ERGO_HD void trace_beside(const Vector3<D>& n, const MaskOf<T>& wanted, PixelLines (&lines)[lanes], int count,
                            SampleHits<T>* met) const {
    const ObjectScene& objects = batch.pixels.objects;
    const CameraStation& camera = objects.camera;
    follow_path<object_order, Parts>(camera.spin, camera.cosine_phi, camera.sine_phi, start_near_ray(camera, n),
                                     {objects.scene.min_r, objects.scene.max_r}, objects.limits, wanted,
                                     [&](int i, const PathStep<object_order, Parts, Dual<double>>& step) {
                                       PixelLines& own = lines[i];
                                       EyeStep<object_order, Parts> eye(step, own.reference(), own.reach());
                                       if (eye.begins_beyond(own.span().farthest)) {
                                         return true;
                                       }
                                       if (!eye.keep(own.span()) || !eye.may_meet(objects.scene)) {
                                         return false;
                                       }
                                       for (int k = 0; k < count; ++k) {
                                         if (own.is_wanted(k) && eye.keep(own.span(k))) {
                                           trace_line(eye, k, own, met[k].hits[i]);
                                         }
                                       }
                                       return !own.any_wanted();
                                     });
  }

  //! Searches the part of a step that EyeStep::keep() has selected for the first mesh that a line
  //! meets.
  ERGO_HD void trace_line(EyeStep<object_order, Parts>& eye, int line, PixelLines& lines, MeshHit& hit) const {
    eye.turn_to(lines.direction(line));
    const PathStep<object_order, Parts, double> path = eye.along();
    detail::StepSearch<object_order, Parts> search = {path, batch.pixels.objects.scene, 0.0, {}};
    if (!search.run()) {
      return;
    }
    eye.see(search.found_h, search.hit);
    if (hit.mesh < 0 || search.hit.time < hit.time) {
      hit = search.hit;
    }
    lines.meet(line);
  }

  //! Stores the energy and the axial angular momentum of the head's ray in a hit. Discards a hit
  //! behind what the eye sees of the horizon.
  ERGO_HD void end(const Vector3<double>& direction, int i, SampleHits<T>& met) const {
    MeshHit& hit = met.hits[i];
    const double w = -hit.time;
    const Vector3<float> m = {static_cast<float>(direction.x), static_cast<float>(direction.y),
                              static_cast<float>(direction.z)};
    if (is_behind_horizon(batch.sight.horizon, m, static_cast<float>(w))) {
      hit.mesh = -1;
      return;
    }
    const Vector3<double> toward = direction + w * batch.sight.eye;
    const NearRay<double> ray = start_near_ray(batch.pixels.objects.camera, (1.0 / length_of(toward)) * toward);
    set_lane(met.energy, i, ray.energy);
    set_lane(met.momentum, i, ray.axial_angular_momentum);
  }
};

//! Computes the light of pixels in which an eye of the stereo model `flat` may see objects. Index i
//! covers pixels i * lanes to (i + 1) * lanes - 1.
template <class T, NearParts Parts>
struct LookAtFlatObjects {
  FlatObjectPixelBatch batch;

  ERGO_HD void operator()(int index) const {
    const ObjectRaysOfHead<T, Parts> rays = {batch};
    ObjectQuads<T, ObjectRaysOfHead<T, Parts>>{batch.pixels, rays}.draw(index);
  }
};

template <class T, class Action>
void dispatch(const FlatObjectPixelBatch& batch, const Action& action) {
  dispatch_flat_objects<LookAtFlatObjects, T>(batch.pixels.objects.retarded, batch, action);
}

}  // namespace ergodome::inline ERGO_TARGET
