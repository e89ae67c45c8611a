#pragma once

#include "kernels/eyes/flat/eye_line.h"
#include "kernels/eyes/flat/eye_path.h"
#include "kernels/objects/tile_pieces.h"

namespace ergodome::inline ERGO_TARGET {

//! Marks the tiles in which an eye of the stereo model `flat` may see objects, and finds how near
//! these may be. The line of sight through a tile's middle is cut into parts, each with a ray of
//! the head, as in MarkTiles. Index i covers tiles i * lanes to (i + 1) * lanes - 1.
template <class T, NearParts Parts>
struct MarkFlatTiles {
  using D = Dual<T>;

  FlatObjectTileBatch batch;

  ERGO_HD void operator()(int index) const {
    const ObjectTileBatch& tiles = batch.tiles;
    const int first = index * lanes;
    Seen seen[lanes];
    EyeLine<T> line;
    line.eye = batch.sight.eye;
    T inside(0.0);
    int max_parts = 0;
    for (int i = 0; i < lanes; ++i) {
      const std::int32_t* const at = tiles.tiles + 2 * (first + i < tiles.count ? first + i : tiles.count - 1);
      const double half = 0.5 * tiles.side_px;
      const Vector3<Dual<double>> one = observed_footprint(tiles.objects, at[0] + half, at[1] + half);
      const double square = dot(plain_vector(one), plain_vector(one));
      const bool sees = square > 0.5 && square < 2.0;
      set_lane(inside, i, sees ? 1.0 : 0.0);
      set_vector_lane(line.m, i, sees ? one : Vector3<Dual<double>>{1.0, 0.0, 0.0});
      seen[i].reference = eye_reference(line.direction(i), batch.sight.eye, 0.0);
      seen[i].from_w = static_cast<double>(along(first + i).min_w);
      const double way = ::fmax(static_cast<double>(along(first + i).max_w) - seen[i].from_w, 0.0);
      seen[i].parts = 1 + static_cast<int>(way * length_of(batch.sight.eye) / batch.part);
      seen[i].step_w = way / seen[i].parts;
      max_parts = max_parts < seen[i].parts ? seen[i].parts : max_parts;
      if (!sees) {
        // If the tile's middle has no direction, all its pixels are drawn.
        see_all(seen[i]);
      }
    }
    for (int part = 0; part < max_parts; ++part) {
      seen_at(line, part, inside > T(0.0), seen);
    }
    for (int i = 0; i < lanes && first + i < tiles.count; ++i) {
      store(first + i, seen[i]);
    }
  }

 private:
  static constexpr int lanes = RealTraits<T>::lane_count;

  //! State of a tile: the objects found so far and their range of nearness to the eye.
  struct Seen {
    EyeReference reference;
    double from_w = 0.0;
    double step_w = 0.0;  //!< range of nearness that one part of the line of sight covers
    int parts = 1;
    TileMark mark = TileMark::nothing;
    double min_w = 1e30;
    double max_w = 0.0;
    double width = 0.0;  //!< maximum width of a pixel at these objects, divided by their r
  };

  ERGO_HD const FlatReach& along(int at) const {
    return batch.along[at < batch.tiles.count ? at : batch.tiles.count - 1];
  }

  //! Width of a pixel (over r) where the search remains undecided, near a critical curve:
  //! unlimited.
  static constexpr double widest = 1e30;
  //! Width of a pixel (over r) beside the shadow's edge. It could be unlimited, too, but this value
  //! leads to two or three rays across a pixel; with the unlimited one, pictures of objects took
  //! 1.4 to 1.7 times as long. Images thinner than a pixel are noisy here.
  static constexpr double width_by_edge = 1.6;

  ERGO_HD static void see_all(Seen& seen) {
    see(seen, TileMark::fine, seen.from_w, seen.from_w + seen.parts * seen.step_w);
    seen.width = widest;
  }
  ERGO_HD static void see(Seen& seen, TileMark mark, double min_w, double max_w) {
    seen.mark = mark > seen.mark ? mark : seen.mark;
    seen.min_w = ::fmin(seen.min_w, min_w);
    seen.max_w = ::fmax(seen.max_w, max_w);
  }

  //! Marks a part of the line of sight beside the shadow's edge, where rays separate at the hole.
  ERGO_HD void see_by_edge(Seen& seen, double middle_w) const {
    const double min_w = middle_w - 0.5 * seen.step_w;
    if (min_w < batch.sight.max_hole_w) {
      see(seen, TileMark::edge, min_w, ::fmin(middle_w + 0.5 * seen.step_w, batch.sight.max_hole_w));
      seen.width = ::fmax(seen.width, width_by_edge);
    }
  }

  //! Searches part number `part` of the tiles' lines of sight for objects.
  ERGO_HD void seen_at(const EyeLine<T>& line, int part, const MaskOf<T>& inside, Seen (&seen)[lanes]) const {
    const ObjectScene& objects = batch.tiles.objects;
    const CameraStation& camera = objects.camera;
    T w(0.0);
    T step_w(0.0);
    T wanted(0.0);
    for (int i = 0; i < lanes; ++i) {
      set_lane(w, i, seen[i].from_w + (part + 0.5) * seen[i].step_w);
      set_lane(step_w, i, seen[i].step_w);
      set_lane(wanted, i, part < seen[i].parts ? 1.0 : 0.0);
    }
    const MaskOf<T> active = inside & (wanted > T(0.0));
    const EyePoint<T> point = line.at(w);
    const T sweep = 0.5 * step_w * (absolute(point.along_x) + absolute(point.along_y));
    const T half_px = 0.5 * batch.tiles.side_px + sweep;
    const auto start = [&camera](const Vector3<T>& at) { return start_near_ray(camera, at); };
    // The edge is sought within the tile, plus the distance by which the line sweeps in each
    // direction.
    const auto half_along = [&](const T& along) {
      return maximum(0.5 * batch.tiles.side_px + 0.5 * step_w * absolute(along), T(min_edge_px));
    };
    const MaskOf<T> by_edge =
        active & is_by_edge(camera.spin, start, point.n, half_along(point.along_x), half_along(point.along_y));
    const double max_r = max_r_of_tiles(objects, point.n, half_px);
    const auto decided = follow_path<mark_order, Parts>(
        camera.spin, camera.cosine_phi, camera.sine_phi, start_near_ray(camera, point.n), {objects.scene.min_r, max_r},
        {mark_tolerance, objects.limits.step_limit, objects.limits.delay}, active,
        [&](int i, const PathStep<mark_order, Parts, Dual<double>>& step) {
          mark_along(step, lane(half_px, i), lane(w, i), 0.75 * seen[i].step_w, seen[i]);
          return false;
        });
    for (int i = 0; i < lanes; ++i) {
      if (mask_lane(active, i) && !mask_lane(decided, i)) {
        see_all(seen[i]);
      } else if (mask_lane(by_edge, i)) {
        see_by_edge(seen[i], lane(w, i));
      }
    }
  }

  //! Marks objects near the head's path whose nearness is within `reach_w` of `w`, the nearness of
  //! the part's middle.
  ERGO_HD void mark_along(const PathStep<mark_order, Parts, Dual<double>>& step, double half_px, double w,
                          double reach_w, Seen& seen) const {
    visit_tile_pieces(batch.tiles.objects.scene, step, {half_px, batch.tiles.turn_per_px, NeighbourTimes::same},
                      [&](const PathPiece& p, double radius, const PixelOnPath& pixel) {
                        const Dual<double> from = step.distance(Dual<double>(p.from_h));
                        const Dual<double> to = step.distance(Dual<double>(p.to_h));
                        const double beside = footprint_slack * half_px * (::fabs(to.along_x) + ::fabs(to.along_y));
                        const double nearest = seen.reference.nearness(from.value - beside);
                        const double farthest = seen.reference.nearness(to.value + beside);
                        // Also true for NaN, which counts as near.
                        if (!(nearest < w - reach_w) && !(farthest > w + reach_w)) {
                          see(seen, mark_of(radius, pixel), ::fmax(farthest, w - reach_w),
                              ::fmin(nearest, w + reach_w));
                          seen.width = ::fmax(seen.width, pixel.width / length_of(p.middle));
                        }
                        return false;
                      });
  }

  ERGO_HD void store(int at, const Seen& seen) const {
    const double max_w = ::fmin(seen.max_w, batch.sight.max_w);
    const double min_w = ::fmin(::fmax(seen.min_w, 0.0), max_w);
    batch.tiles.marks[at] = mark_of_line(seen.mark, (max_w - min_w) * length_of(batch.sight.eye));
    batch.reach[at] = {static_cast<float>(min_w), static_cast<float>(max_w), static_cast<float>(seen.width)};
  }

  //! Returns the mark of a line. Replaces slices by `fine` where their lines sweep past many of the
  //! head's pixels, since slices bring no benefit there.
  ERGO_HD TileMark mark_of_line(TileMark mark, double way) const {
    return mark > TileMark::fine && way > max_way_of_slices * batch.sight.pixel ? TileMark::fine : mark;
  }
};

template <class T, class Action>
void dispatch(const FlatObjectTileBatch& batch, const Action& action) {
  dispatch_flat_objects<MarkFlatTiles, T>(batch.tiles.objects.retarded, batch, action);
}

}  // namespace ergodome::inline ERGO_TARGET
