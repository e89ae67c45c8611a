#pragma once

#include "kernels/mesh/eye_path.h"
#include "kernels/mesh/look_at_objects_kernel.h"

namespace ergodome::inline ERGO_TARGET {

//! Objects as an eye of the stereo model `flat` meets them along its lines of sight: part by part from the nearest on, each beside a ray of the head's.
template <class T, NearParts Parts>
struct ObjectRaysOfHead {
  using D = Dual<T>;

  const FlatObjectPixelBatch& batch;

  ERGO_HD void find(int first, const Vector3<T>& m, MeshHit* hits, T& energy, T& momentum) const {
    Lines lines(batch, first, m);
    energy = T(1.0);
    momentum = T(0.0);
    for (int i = 0; i < lanes; ++i) {
      hits[i] = MeshHit{};
    }
    for (int part = 0; any(lines.turn_to(part)); ++part) {
      look(lines, hits);
    }
    for (int i = 0; i < lanes; ++i) {
      if (hits[i].mesh >= 0) {
        end(lines.reference[i], hits[i], i, energy, momentum);
      }
    }
  }

 private:
  static constexpr int lanes = RealTraits<T>::lane_count;

  //! What one of the head's rays may stand for along a line of sight, as the head sees it. A neighbour at δ px is off by some ½ δ² of how fast the width of
  //! a pixel grows, for which its square over r is taken [px]: towards a critical curve both grow alike.
  ERGO_HD static double part_px(double width) {
    constexpr double off_px = 0.1;
    constexpr double longest_px = 2.0;
    constexpr double shortest_px = 0.25;
    return ::fmax(shortest_px, ::fmin(longest_px, 2.0 * ::sqrt(2.0 * off_px / ::fmax(width, 1e-9))));
  }

  //! The part of each line that is looked along.
  struct Lines {
    EyeReference reference[lanes];
    double nearest[lanes], farthest[lanes];  //!< from the head [M]
    Vector3<D> n;                            //!< of the references
    double part[lanes];                      //!< that one ray stands for [rad]
    T left;                                  //!< 1 in lanes that are not done

    ERGO_HD Lines(const FlatObjectPixelBatch& flat, int first, const Vector3<T>& directions) : left(0.0), batch(flat) {
      for (int i = 0; i < lanes; ++i) {
        m[i] = {lane(directions.x, i), lane(directions.y, i), lane(directions.z, i)};
        const FlatReach& reach = flat.reach[first + i < flat.pixels.count ? first + i : flat.pixels.count - 1];
        from_w[i] = static_cast<double>(reach.most_w);
        to_w[i] = static_cast<double>(reach.least_w);
        part[i] = flat.sight.pixel * part_px(static_cast<double>(reach.width));
        const double square = dot(m[i], m[i]);
        const double sweep = (from_w[i] - to_w[i]) * length_of(flat.sight.eye);
        const bool looks = square > 0.5 && square < 2.0;
        count[i] = looks && sweep > 0.0 ? 1 + static_cast<int>(sweep / part[i]) : 0;
        reference[i] = eye_reference(looks ? m[i] : Vector3<double>{1.0, 0.0, 0.0}, flat.sight.eye, 0.0);
        set_direction(i);
      }
    }

    //! Goes to the part of a number; tells which lanes have one.
    ERGO_HD MaskOf<T> turn_to(int part) {
      T wanted(0.0);
      for (int i = 0; i < lanes; ++i) {
        if (!(part < count[i])) {
          continue;
        }
        const double step = (from_w[i] - to_w[i]) / count[i];
        const double w = from_w[i] - (part + 0.5) * step;
        reference[i] = eye_reference(m[i], batch.sight.eye, w);
        // Neighbours do not meet to the last digit.
        constexpr double overlap = 1e-3;
        nearest[i] = reference[i].distance(w + (0.5 + overlap) * step);
        farthest[i] = reference[i].distance(::fmax(w - (0.5 + overlap) * step, 0.0));
        set_direction(i);
        set_lane(wanted, i, 1.0);
      }
      left = wanted;
      return wanted > T(0.0);
    }

    ERGO_HD void done(int i) { count[i] = 0; }

   private:
    ERGO_HD void set_direction(int i) {
      const auto set = [i](D& to, double value, double across, double down) {
        set_lane(to.value, i, value);
        set_lane(to.along_x, i, across);
        set_lane(to.along_y, i, down);
      };
      const EyeReference& own = reference[i];
      set(n.x, own.n.x, own.across.x, own.down.x);
      set(n.y, own.n.y, own.across.y, own.down.y);
      set(n.z, own.n.z, own.across.z, own.down.z);
    }

    const FlatObjectPixelBatch& batch;
    Vector3<double> m[lanes];
    double from_w[lanes], to_w[lanes];
    int count[lanes];
  };

  ERGO_HD void look(Lines& lines, MeshHit* hits) const {
    const ObjectScene& objects = batch.pixels.objects;
    const CameraStation& camera = objects.camera;
    follow_path<object_order, Parts>(
        camera.spin, camera.cosine_phi, camera.sine_phi, start_near_ray(camera, lines.n),
        {objects.scene.least_r, objects.scene.greatest_r}, objects.limits, lines.left > T(0.0),
        [&](int i, const PathStep<object_order, Parts, Dual<double>>& step) {
          EyeStep<object_order, Parts> eye(step, lines.reference[i], 0.5 * lines.part[i]);
          if (eye.begins_beyond(lines.farthest[i])) {
            return true;
          }
          if (!eye.keep(lines.nearest[i], lines.farthest[i]) || !eye.may_meet(objects.scene)) {
            return false;
          }
          const PathStep<object_order, Parts, double> path = eye.along();
          detail::StepSearch<object_order, Parts> search = {path, objects.scene, 0.0, {}};
          const bool found = search.run();
          if (found) {
            hits[i] = search.hit;
            eye.see(search.found_h, hits[i]);
            lines.done(i);
          }
          return found;
        });
  }

  //! What the head's ray to a hit is like; nothing is met behind what the eye sees of the horizon.
  ERGO_HD void end(const EyeReference& reference, MeshHit& hit, int i, T& energy, T& momentum) const {
    const CameraStation& camera = batch.pixels.objects.camera;
    const double w = -hit.time;
    const Vector3<float> m = {static_cast<float>(reference.m.x), static_cast<float>(reference.m.y),
                              static_cast<float>(reference.m.z)};
    if (is_behind_horizon(batch.sight.horizon, m, static_cast<float>(w))) {
      hit.mesh = -1;
      return;
    }
    double length = 0.0;
    const NearRay<double> ray = start_near_ray(camera, reference.toward(w, length));
    set_lane(energy, i, ray.energy);
    set_lane(momentum, i, ray.axial_angular_momentum);
  }
};

//! Light of pixels in which such an eye may see objects. Index i stands for the pixels i * lanes, i * lanes + 1, ...
template <class T, NearParts Parts>
struct LookAtFlatObjects {
  FlatObjectPixelBatch batch;

  ERGO_HD void operator()(int index) const {
    const ObjectRaysOfHead<T, Parts> rays = {batch};
    ObjectQuads<T, ObjectRaysOfHead<T, Parts>>{batch.pixels, rays}.draw(index);
  }
};

}  // namespace ergodome::inline ERGO_TARGET
