#pragma once

#include "kernels/objects/draw_objects.h"
#include "kernels/objects/object_sight.h"

// Finds which objects the pixels of a tile may see, by the ray through the tile's middle and its
// derivatives per pixel.
namespace ergodome::inline ERGO_TARGET {

//! Order of the Taylor series, and precision, of the rays through the middles of tiles.
inline constexpr int mark_order = 8;
inline constexpr double mark_tolerance = 1e-6;
//! Factor on the size of linear footprints, since real ones bend.
inline constexpr double footprint_slack = 1.6;

//! Sets a lane of a vector with its derivatives.
template <class T>
ERGO_HD void set_vector_lane(Vector3<Dual<T>>& v, int i, const Vector3<Dual<double>>& one) {
  const auto set = [i](Dual<T>& to, const Dual<double>& from) {
    set_lane(to.value, i, from.value);
    set_lane(to.along_x, i, from.along_x);
    set_lane(to.along_y, i, from.along_y);
  };
  set(v.x, one.x);
  set(v.y, one.y);
  set(v.z, one.z);
}

//! Minimum distance within which the edge is sought [px], as the ray in the middle does not predict
//! footprints next to the edge.
inline constexpr double min_edge_px = 0.7;

//! Returns the lanes where the edge of a shadow is within `half_x_px` and `half_y_px` of a
//! direction, if the shadow is larger than that. The ray in the middle does not predict what is
//! seen beside the edge. start(n) returns the ray that is seen in a direction.
template <class T, class Start>
ERGO_HD MaskOf<T> is_by_edge(ScalarOf<T> spin, const Start& start, const Vector3<Dual<T>>& n, const T& half_x_px,
                             const T& half_y_px) {
  const auto falls = [&](double along, double down) {
    const auto part = [&](const Dual<T>& of) {
      return of.value + footprint_slack * (along * half_x_px * of.along_x + down * half_y_px * of.along_y);
    };
    const Vector3<T> at = {part(n.x), part(n.y), part(n.z)};
    return comes_from_hole(spin, start((1.0 / sqrt(dot(at, at))) * at));
  };
  const MaskOf<T> middle = falls(0.0, 0.0);
  MaskOf<T> all = middle;
  MaskOf<T> some = middle;
  for (int corner = 0; corner < 4; ++corner) {
    const MaskOf<T> own = falls(corner % 2 == 0 ? -1.0 : 1.0, corner < 2 ? -1.0 : 1.0);
    all = all & own;
    some = some | own;
  }
  return some & !all;
}

//! Returns the radius within which the rays of tiles are followed. It is larger than that of the
//! ball about all objects, because some rays of a tile may enter the ball although the ray in the
//! tile's middle, in direction n, does not.
template <class T>
ERGO_HD double max_r_of_tiles(const ObjectScene& objects, const Vector3<Dual<T>>& n, const T& half_px) {
  double beside = 0.0;
  for (int i = 0; i < RealTraits<T>::lane_count; ++i) {
    const Vector3<double> x = {lane(n.x.along_x, i), lane(n.y.along_x, i), lane(n.z.along_x, i)};
    const Vector3<double> y = {lane(n.x.along_y, i), lane(n.y.along_y, i), lane(n.z.along_y, i)};
    beside = ::fmax(beside, lane(half_px, i) * (length_of(x) + length_of(y)));
  }
  const double r = objects.scene.max_r;
  return r + footprint_slack * beside * (1.0 / objects.camera.u + r);
}

//! A pixel's footprint on the path of the ray in its middle [M]: distances of the rays of the
//! adjacent pixels at the same time.
struct PixelOnPath {
  //! Distances of the rays of the next pixels in x and in y of the picture, added.
  double width;
  double across, along;  //!< components of `width` across the path and along it
  //! Maximum and minimum distance of the ray of a next pixel, across the path.
  double widest, narrowest;
  Vector3<double> narrow;  //!< unit vector in which `narrowest` is measured
};

//! Minimum ratio of `widest` to `narrowest` of stretched images. Images are stretched about a hole,
//! and more so next to the shadow's edge.
inline constexpr double stretched_part = 4.0;

//! Which neighbors of a ray count as near to an object: those at the same time, or those at any
//! time.
enum class NeighbourTimes { same, any };

ERGO_HD PixelOnPath pixel_on_path(const Vector3<Dual<double>>& position, const Vector3<double>& way) {
  const Vector3<double> x = {position.x.along_x, position.y.along_x, position.z.along_x};
  const Vector3<double> y = {position.x.along_y, position.y.along_y, position.z.along_y};
  const double square = ::fmax(dot(way, way), 1e-300);
  const double x_along = dot(x, way) / square;
  const double y_along = dot(y, way) / square;
  const Vector3<double> x_across = x - x_along * way;
  const Vector3<double> y_across = y - y_along * way;
  const double xx = dot(x_across, x_across);
  const double yy = dot(y_across, y_across);
  const double xy = dot(x_across, y_across);
  const double spread = ::sqrt(0.25 * (xx - yy) * (xx - yy) + xy * xy);
  const double middle = 0.5 * (xx + yy);
  // Angle of the (s, t) for which s x + t y is longest, with s² + t² = 1.
  const double turn = 0.5 * ::atan2(2.0 * xy, xx - yy);
  const Vector3<double> wide = ::cos(turn) * x_across + ::sin(turn) * y_across;
  const Vector3<double> narrow = cross(way, wide);
  const double length = ::fmax(length_of(narrow), 1e-300);
  return {length_of(x) + length_of(y),
          ::sqrt(xx) + ::sqrt(yy),
          (::fabs(x_along) + ::fabs(y_along)) * ::sqrt(square),
          ::sqrt(middle + spread),
          ::sqrt(::fmax(middle - spread, 0.0)),
          (1.0 / length) * narrow};
}

//! Returns the maximum distance of a ray's neighbors, at most `within_px` pixels away, from the
//! surface along which their image is stretched [M].
ERGO_HD double reach_out_of_plane(const PixelOnPath& pixel, double within_px, double turn_per_px) {
  // Rays that separate beside a hole stay in one plane through it, except for the rotation by its
  // spin.
  constexpr double turned = 0.15;
  return within_px * (::sqrt(2.0) * pixel.narrowest + (turned + within_px * turn_per_px) * pixel.widest);
}

//! The range of pixels around a ray's pixel for which the ray is representative.
struct Neighbours {
  double half_px;      //!< maximum distance of these pixels in the picture
  double turn_per_px;  //!< rotation of the planes of their rays from pixel to pixel [rad]
  NeighbourTimes times;
};

//! Returns the maximum distance between a piece of a ray's path and its neighbors, which are at
//! most `within_px` pixels away in the picture [M].
ERGO_HD double footprint_reach(const PathPiece& piece, const PixelOnPath& pixel, double within_px,
                               NeighbourTimes times) {
  const double whole = within_px * pixel.width;
  if (times == NeighbourTimes::same) {
    return whole;
  }
  // Neighbors ahead or behind pass here at another time. Until then they leave the path only by its
  // bend and by the change of its footprint.
  const double chord = ::fmax(piece.chord(), 1e-300);
  const double bend = 2.0 * piece.stray() / (chord * chord);
  const double ahead = within_px * pixel.along;
  const double aside = ahead * ahead * (bend + 1.0 / length_of(piece.middle));
  // If `beside` is NaN, the result is the whole width.
  const double beside = within_px * pixel.across + aside;
  return beside < whole ? beside : whole;
}

//! A pixel wider than this fraction of an object's radius may contain more of it than a few samples
//! show.
inline constexpr double fine_part = 0.15;

//! Returns the mark for an object with a bounding ball of this radius [M] where a pixel has this
//! footprint.
ERGO_HD TileMark mark_of(double radius, const PixelOnPath& pixel) {
  constexpr double thin_px = 4.0;
  const bool is_stretched = !(pixel.widest < stretched_part * pixel.narrowest);
  if (is_stretched && !(thin_px * pixel.widest < 2.0 * radius)) {
    return TileMark::thin;
  }
  if (!(pixel.width < fine_part * radius)) {
    return TileMark::fine;
  }
  return is_stretched ? TileMark::stretched : TileMark::objects;
}

//! Calls each(piece, radius, pixel) for the pieces of a step that come so near to a mesh's bounding
//! ball that neighbors of the ray may meet it, until `each` returns true. `radius`: that of the
//! ball.
template <NearParts Parts, class Each>
ERGO_HD void visit_tile_pieces(const MeshScene& scene, const PathStep<mark_order, Parts, Dual<double>>& step,
                               const Neighbours& neighbours, const Each& each) {
  constexpr double max_unevenness = 0.05;
  const double within_px = footprint_slack * neighbours.half_px;
  const auto position = [&](double h) { return plain_vector(step.point(Dual<double>(h))); };
  visit_pieces(step.length, 1e-9 * scene.max_r, max_unevenness, position, [&](const PathPiece& p) {
    const PixelOnPath pixel = pixel_on_path(step.point(Dual<double>(p.middle_h())), p.to - p.from);
    // The footprint is computed in the middle of the piece, but changes along it.
    const double reach =
        p.stray() + 2.0 * ::fabs(p.unevenness()) * p.chord() + footprint_reach(p, pixel, within_px, neighbours.times);
    // `stretched` is false if a width is NaN.
    const bool stretched = pixel.widest > stretched_part * pixel.narrowest && length_of(pixel.narrow) > 0.5;
    const double beside = stretched ? p.stray() + reach_out_of_plane(pixel, within_px, neighbours.turn_per_px) : 0.0;
    bool enough = false;
    for (int i = 0; i < scene.count && !enough; ++i) {
      const PlacedMesh& mesh = scene.meshes[i];
      const double radius = mesh.size * mesh.tree.radius;
      const Vector3<double> at = has_delay(Parts) ? mesh_position(mesh, step.delay(p.middle_h())) : mesh.position;
      double moved = 0.0;
      if (has_delay(Parts) && mesh.retarded) {
        moved = length_of(mesh_position(mesh, step.delay(p.from_h)) - mesh_position(mesh, step.delay(p.to_h)));
      }
      const Vector3<double> middle = ball_middle(mesh, at);
      if (stretched && ::fabs(dot(pixel.narrow, middle - p.middle)) > radius + beside + moved) {
        continue;
      }
      // Also true for NaN, which counts as near.
      if (!(distance_from_segment(middle, p.from, p.to) > radius + reach + moved)) {
        enough = each(p, radius, pixel);
      }
    }
    return enough ? PieceAnswer::stop : PieceAnswer::finish;
  });
}

}  // namespace ergodome::inline ERGO_TARGET
