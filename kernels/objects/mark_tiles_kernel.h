#pragma once

#include "kernels/objects/tile_pieces.h"

namespace ergodome::inline ERGO_TARGET {

//! Marks the tiles in which objects may be seen: those where an object's bounding ball comes within
//! the footprint of the ray through the tile's middle, whichever way round the hole, and those
//! beside the shadow's edge. Index i covers tiles i * lanes to (i + 1) * lanes - 1.
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
      const bool sees = size > 0.5 && size < 2.0;
      // If the tile's middle has no direction, all its pixels are drawn.
      marks[i] = sees ? TileMark::nothing : TileMark::fine;
      set_lane(inside, i, sees ? 1.0 : 0.0);
      set_vector_lane(n, i, sees ? one : Vector3<Dual<double>>{1.0, 0.0, 0.0});
    }
    const CameraStation& camera = objects.camera;
    const auto start = [&objects](const auto& at) { return start_near_ray(objects.camera, objects.omni, at); };
    const T edge_px(::fmax(half, min_edge_px));
    const auto by_edge = (inside > T(0.0)) & is_by_edge(camera.spin, start, n, edge_px, edge_px);
    for (int i = 0; i < lanes; ++i) {
      marks[i] = mask_lane(by_edge, i) ? TileMark::edge : marks[i];
    }
    const auto decided = follow_path<mark_order, Parts>(
        camera.spin, camera.cosine_phi, camera.sine_phi, start(n),
        {objects.scene.min_r, max_r_of_tiles(objects, n, T(half))},
        {mark_tolerance, objects.limits.step_limit, objects.limits.delay}, (inside > T(0.0)) & !by_edge,
        [&](int i, const PathStep<mark_order, Parts, Dual<double>>& step) {
          marks[i] = mark_along(step, marks[i]);
          return marks[i] == TileMark::thin;
        });
    for (int i = 0; i < lanes && first + i < batch.count; ++i) {
      batch.marks[first + i] = mask_lane(decided, i) ? marks[i] : TileMark::fine;
    }
  }

 private:
  ERGO_HD TileMark mark_along(const PathStep<mark_order, Parts, Dual<double>>& step, TileMark mark) const {
    visit_tile_pieces(batch.objects.scene, step, {0.5 * batch.side_px, batch.turn_per_px, NeighbourTimes::any},
                      [&](const PathPiece&, double radius, const PixelOnPath& pixel) {
                        const TileMark own = mark_of(radius, pixel);
                        mark = own > mark ? own : mark;
                        return mark == TileMark::thin;
                      });
    return mark;
  }
};

template <class T, class Action>
void dispatch(const ObjectTileBatch& batch, const Action& action) {
  dispatch_objects<MarkTiles, T>(batch, action);
}

}  // namespace ergodome::inline ERGO_TARGET
