#pragma once

#include "kernels/objects/draw_objects.h"
#include "kernels/objects/object_sight.h"

// What tiles of an image may see of objects, by the ray through a tile's middle and its derivatives per pixel.
namespace ergodome::inline ERGO_TARGET {

//! How the rays of tiles are followed.
inline constexpr int mark_order = 8;
inline constexpr double mark_tolerance = 1e-6;
//! Footprints bend: what lies beyond the linear one by this part of it is still looked for.
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

//! Next to the edge, too, footprints are not what a ray in the middle tells: the edge is looked for so far from it at the least [px].
inline constexpr double least_edge_px = 0.7;

//! Lanes with the edge of a shadow, larger than that, within `half_x_px` and `half_y_px` of a direction: what is seen beside it is not told by the ray in the
//! middle. start(n) is the ray that is seen in a direction.
template <class T, class Start>
ERGO_HD MaskOf<T> is_by_edge(double spin, const Start& start, const Vector3<Dual<T>>& n, const T& half_x_px,
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

//! The radius within which the rays of tiles are looked at: they may pass the ball about all objects where that of their middle, n, does not.
template <class T>
ERGO_HD double greatest_r_of_tiles(const ObjectScene& objects, const Vector3<Dual<T>>& n, const T& half_px) {
  double beside = 0.0;
  for (int i = 0; i < RealTraits<T>::lane_count; ++i) {
    const Vector3<double> x = {lane(n.x.along_x, i), lane(n.y.along_x, i), lane(n.z.along_x, i)};
    const Vector3<double> y = {lane(n.x.along_y, i), lane(n.y.along_y, i), lane(n.z.along_y, i)};
    beside = ::fmax(beside, lane(half_px, i) * (length_of(x) + length_of(y)));
  }
  const double r = objects.scene.greatest_r;
  return r + footprint_slack * beside * (1.0 / objects.camera.u + r);
}

//! A pixel where the path of the ray in its middle is [M]: how far its neighbours are from that at the same time.
struct PixelOnPath {
  double width;              //!< in x and y of the picture together
  double across, along;      //!< the same, across the path and along it
  double widest, narrowest;  //!< across it
  Vector3<double> narrow;    //!< where the latter points
};

//! Images are stretched about a hole, by this and more next to the shadow's edge.
inline constexpr double stretched_part = 4.0;

//! Which neighbours of a ray are near to a thing: those that are at the same time, or those that are at any.
enum class NeighbourTimes { same, any };

ERGO_HD PixelOnPath pixel_on_path(const Vector3<Dual<double>>& place, const Vector3<double>& way) {
  const Vector3<double> x = {place.x.along_x, place.y.along_x, place.z.along_x};
  const Vector3<double> y = {place.x.along_y, place.y.along_y, place.z.along_y};
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
  // Of all s x + t y with s² + t² = 1 the longest.
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

//! How far neighbours of a ray within some pixels go out of the surface that they are stretched in [M].
ERGO_HD double reach_out_of_plane(const PixelOnPath& pixel, double within_px, double turn_per_px) {
  // Rays that part beside a hole stay in one plane through it, but for what its spin turns them.
  constexpr double turned = 0.15;
  return within_px * (::sqrt(2.0) * pixel.narrowest + (turned + within_px * turn_per_px) * pixel.widest);
}

//! Pixels about a ray.
struct Neighbours {
  double half_px;      //!< they are so far from it in the picture
  double turn_per_px;  //!< by so much the planes of their rays are turned [rad]
  NeighbourTimes times;
};

//! How far from a piece of a ray's path its neighbours within some pixels are [M].
ERGO_HD double footprint_reach(const PathPiece& piece, const PixelOnPath& pixel, double within_px,
                               NeighbourTimes times) {
  const double whole = within_px * pixel.width;
  if (times == NeighbourTimes::same) {
    return whole;
  }
  // Neighbours that are ahead or behind have been here, or will be: beside the path as far as it bends and as its footprint changes until then.
  const double chord = ::fmax(piece.chord(), 1e-300);
  const double bend = 2.0 * piece.stray() / (chord * chord);
  const double ahead = within_px * pixel.along;
  const double aside = ahead * ahead * (bend + 1.0 / length_of(piece.middle));
  // What is not a number is the whole.
  const double beside = within_px * pixel.across + aside;
  return beside < whole ? beside : whole;
}

//! A pixel of more than this part of an object's radius may hold more of it than a few samples tell.
inline constexpr double fine_part = 0.15;

//! How an object of such a radius is looked at.
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

//! Calls each(piece, radius, pixel) for the pieces of a step that the ball of such a radius about a mesh comes so near to that its neighbours
//! may meet it, until it says that it is enough.
template <NearParts Parts, class Each>
ERGO_HD void visit_tile_pieces(const MeshScene& scene, const PathStep<mark_order, Parts, Dual<double>>& step,
                               const Neighbours& neighbours, const Each& each) {
  constexpr double most_uneven = 0.05;
  const double within_px = footprint_slack * neighbours.half_px;
  const auto place = [&](double h) { return plain_vector(step.point(Dual<double>(h))); };
  visit_pieces(step.length, 1e-9 * scene.greatest_r, most_uneven, place, [&](const PathPiece& p) {
    const PixelOnPath pixel = pixel_on_path(step.point(Dual<double>(p.middle_h())), p.to - p.from);
    // The middle stands for the whole piece, whose footprint grows along it.
    const double reach =
        p.stray() + 2.0 * ::fabs(p.unevenness()) * p.chord() + footprint_reach(p, pixel, within_px, neighbours.times);
    // What is not a number is not stretched.
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
      // What is not a number is near, too.
      if (!(distance_from_segment(middle, p.from, p.to) > radius + reach + moved)) {
        enough = each(p, radius, pixel);
      }
    }
    return enough ? PieceAnswer::stop : PieceAnswer::finish;
  });
}

}  // namespace ergodome::inline ERGO_TARGET
