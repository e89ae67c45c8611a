#pragma once

#include "kernels/mesh/draw_objects.h"
#include "kernels/mesh/object_sight.h"

namespace ergodome::inline ERGO_TARGET {

//! Marks the tiles in which objects may be seen: those where the balls about them come within the footprint of the ray through the tile's middle,
//! whichever way round the hole. Index i stands for the tiles i * lanes, i * lanes + 1, ...
template <class T, NearParts Parts>
struct MarkTiles {
  using D = Dual<T>;

  ObjectTileBatch batch;

  ERGO_HD void operator()(int index) const {
    constexpr int lanes = RealTraits<T>::lane_count;
    const ObjectScene& objects = batch.objects;
    const int first = index * lanes;
    const double half = 0.5 * batch.side_px;
    Vector3<D> n;
    T inside(0.0);
    TileMark marks[lanes];
    for (int i = 0; i < lanes; ++i) {
      const std::int32_t* const at = batch.tiles + 2 * (first + i < batch.count ? first + i : batch.count - 1);
      const Vector3<Dual<double>> one = observed_footprint(objects, at[0] + half, at[1] + half);
      const double size = dot(plain_vector(one), plain_vector(one));
      const bool looks = size > 0.5 && size < 2.0;
      // Where the tile's middle looks nowhere, its pixels are all looked at.
      marks[i] = looks ? TileMark::nothing : TileMark::fine;
      set_lane(inside, i, looks ? 1.0 : 0.0);
      set_direction(n, i, looks ? one : Vector3<Dual<double>>{1.0, 0.0, 0.0});
    }
    const CameraStation& camera = objects.camera;
    const auto decided = follow_path<mark_order, Parts>(
        camera.spin, camera.cosine_phi, camera.sine_phi, start_near_ray(camera, objects.turning, n),
        {objects.scene.least_r, objects.scene.greatest_r}, {mark_tolerance, objects.limits.step_limit}, inside > T(0.0),
        [&](int i, const PathStep<mark_order, Parts, Dual<double>>& step) {
          marks[i] = look_through(step, marks[i]);
          return marks[i] == TileMark::fine;
        });
    for (int i = 0; i < lanes && first + i < batch.count; ++i) {
      batch.marks[first + i] = mask_lane(decided, i) ? marks[i] : TileMark::fine;
    }
  }

 private:
  static constexpr int mark_order = 8;
  static constexpr double mark_tolerance = 1e-6;
  //! Footprints bend: what lies beyond the linear one by this part of it is still looked for.
  static constexpr double slack = 1.6;
  //! A pixel of more than this part of an object's radius may hold more than a few samples tell.
  static constexpr double fine_part = 0.15;

  ERGO_HD static void set_direction(Vector3<D>& n, int i, const Vector3<Dual<double>>& one) {
    const auto set = [i](D& to, const Dual<double>& from) {
      set_lane(to.value, i, from.value);
      set_lane(to.along_x, i, from.along_x);
      set_lane(to.along_y, i, from.along_y);
    };
    set(n.x, one.x);
    set(n.y, one.y);
    set(n.z, one.z);
  }

  ERGO_HD TileMark look_through(const PathStep<mark_order, Parts, Dual<double>>& step, TileMark mark) const {
    const MeshScene& scene = batch.objects.scene;
    const auto place = [&](double h) { return plain_vector(step.point(Dual<double>(h))); };
    constexpr double most_uneven = 0.05;
    visit_pieces(step.length, 1e-9 * scene.greatest_r, most_uneven, place, [&](const PathPiece& p) {
      const Vector3<Dual<double>> middle = step.point(Dual<double>(p.middle_h()));
      const double width = length_of({middle.x.along_x, middle.y.along_x, middle.z.along_x}) +
                           length_of({middle.x.along_y, middle.y.along_y, middle.z.along_y});
      // The middle stands for the whole piece, whose footprint grows along it.
      const double reach = p.stray() + 2.0 * ::fabs(p.unevenness()) * p.chord() + slack * 0.5 * batch.side_px * width;
      for (int i = 0; i < scene.count; ++i) {
        const PlacedMesh& mesh = scene.meshes[i];
        const double radius = mesh.size * mesh.tree.radius;
        const Vector3<double> at = has_delay(Parts) ? mesh_position(mesh, step.delay(p.middle_h())) : mesh.position;
        double moved = 0.0;
        if (has_delay(Parts) && mesh.retarded) {
          moved = length_of(mesh_position(mesh, step.delay(p.from_h)) - mesh_position(mesh, step.delay(p.to_h)));
        }
        // What is not a number is near, too.
        if (!(distance_from_segment(ball_middle(mesh, at), p.from, p.to) > radius + reach + moved)) {
          mark = !(width < fine_part * radius) ? TileMark::fine : mark == TileMark::fine ? mark : TileMark::objects;
        }
      }
      return mark == TileMark::fine ? PieceAnswer::stop : PieceAnswer::finish;
    });
    return mark;
  }
};

}  // namespace ergodome::inline ERGO_TARGET
