#pragma once

#include "kernels/core/find_root.h"
#include "kernels/objects/path_parabola.h"

// Finds the triangle that a ray's path meets first.
namespace ergodome {

//! The point of a mesh that a ray meets, from which its light comes.
struct MeshHit {
  int mesh = -1;                 //!< -1: no mesh
  std::uint32_t tree_index = 0;  //!< index of the triangle in its TriangleTree
  double weight_1 = 0.0;         //!< weights of the second and the third corner; the first has the rest
  double weight_2 = 0.0;
  Vector3<double> point;  //!< position of the hit, pseudo-Cartesian [M]
  //! Coordinate time from the hit to the camera [M]; only with NearParts::azimuth_and_delay.
  double delay = 0.0;
  //! Mino time from the hit to the camera, for a photon seen with energy 1 [1/M].
  double time = 0.0;
  //! Rate du/dλ of the ray at the hit, backwards; u = 1/r, λ: Mino time.
  double u_rate = 0.0;
  //! Rate dm/dλ of the ray at the hit, backwards, pseudo-Cartesian [M]; m: unit vector from the
  //! hole.
  Vector3<double> polar_momentum;
};

inline namespace ERGO_TARGET {

namespace detail {

//! A path, transformed to the unit and the axes of a mesh; the mesh may move while light passes.
template <int Order, NearParts Parts>
struct PathInMesh {
  const PathStep<Order, Parts, double>& step;
  const PlacedMesh& mesh;

  ERGO_HD Vector3<double> at(double h, const Vector3<double>& point) const {
    return in_mesh(mesh, has_delay(Parts) ? mesh_position(mesh, step.delay(h)) : mesh.position, point);
  }
  ERGO_HD Vector3<double> operator()(double h) const { return at(h, step.point(h)); }

  ERGO_HD PathPiece piece(const PathPiece& p) const {
    return {p.from_h, p.to_h, at(p.from_h, p.from), at(p.middle_h(), p.middle), at(p.to_h, p.to)};
  }
};

//! The path's signed distance from a triangle's plane, times twice the triangle's area.
template <class Path>
struct PlaneDistance {
  const Path& path;
  Vector3<double> corner;
  Vector3<double> normal;

  ERGO_HD double of(const Vector3<double>& point) const { return dot(normal, point - corner); }
  ERGO_HD double operator()(double h) const { return of(path(h)); }
};

//! Tests the triangles that a piece may cross, and keeps the first crossing.
template <class Path>
struct PieceCrossings {
  const Path& path;
  const PathPiece& piece;  //!< the piece in the mesh's unit
  PathParabola parabola;
  int index;
  double first_h;
  MeshHit hit;

  //! Returns the position of the first crossing, as a fraction of the piece; above 1 if there is
  //! none yet.
  ERGO_HD double first_s() const { return (first_h - piece.from_h) / (piece.to_h - piece.from_h); }

  ERGO_HD void operator()(std::uint32_t tree_index) {
    const TriangleSides sides = triangle_sides(path.mesh.tree, tree_index);
    const PlaneDistance<Path> f = {path, sides.corner, cross(sides.side_1, sides.side_2)};
    const double at_from = f.of(piece.from);
    const double at_middle = f.of(piece.middle);
    const double at_to = f.of(piece.to);
    if (!may_cross(parabola, {sides, f.normal, at_from, at_middle, at_to}, first_s())) {
      return;
    }
    if ((at_from < 0.0) != (at_to < 0.0)) {
      keep(f, sides, tree_index, piece.from_h, piece.to_h, at_from);
      return;
    }
    // A path that bends may pass the plane and come back; the parabola through three points gives
    // its turning point.
    const double bow = 2.0 * (at_from + at_to) - 4.0 * at_middle;
    const double share = bow != 0.0 ? 0.5 - 0.5 * (at_to - at_from) / bow : -1.0;
    if (!(share > 0.0 && share < 1.0)) {
      return;
    }
    const double turn = piece.from_h + share * (piece.to_h - piece.from_h);
    const double at_turn = f(turn);
    if ((at_turn < 0.0) != (at_from < 0.0)) {
      keep(f, sides, tree_index, piece.from_h, turn, at_from);
      keep(f, sides, tree_index, turn, piece.to_h, at_turn);
    }
  }

  //! Keeps the crossing of a triangle's plane between two times if it lies within the triangle and
  //! is the first so far.
  ERGO_HD void keep(const PlaneDistance<Path>& f, const TriangleSides& sides, std::uint32_t tree_index, double from_h,
                    double to_h, double at_from) {
    if (!(from_h < first_h)) {
      return;
    }
    const double side = at_from < 0.0 ? 1.0 : -1.0;
    const double h = find_root(from_h, to_h, [&](double at) { return side * f(at); });
    if (!(h < first_h)) {
      return;
    }
    const Vector3<double> from_corner = path(h) - sides.corner;
    const double area = dot(f.normal, f.normal);
    const double weight_1 = dot(cross(from_corner, sides.side_2), f.normal) / area;
    const double weight_2 = dot(cross(sides.side_1, from_corner), f.normal) / area;
    // A small overlap, so that triangles with a common side leave no gap.
    constexpr double seam = 1e-9;
    if (weight_1 >= -seam && weight_2 >= -seam && weight_1 + weight_2 <= 1.0 + seam) {
      first_h = h;
      hit.mesh = index;
      hit.tree_index = tree_index;
      hit.weight_1 = weight_1;
      hit.weight_2 = weight_2;
    }
  }
};

//! Searches the path of a step for meshes, piece by piece.
template <int Order, NearParts Parts>
struct StepSearch {
  const PathStep<Order, Parts, double>& step;
  const MeshScene& scene;
  double found_h = 0.0;
  MeshHit hit;

  ERGO_HD PathInMesh<Order, Parts> in(int mesh) const { return {step, scene.meshes[mesh]}; }

  //! Returns whether a piece may meet a mesh at rest.
  ERGO_HD static bool passes(const PlacedMesh& mesh, const PathPiece& p, double stray) {
    return distance_from_segment(ball_middle(mesh, mesh.position), p.from, p.to) <=
           mesh.size * mesh.tree.radius + stray;
  }

  //! Searches a piece if it comes near a mesh, and stops if it meets one. Before that, the piece is
  //! cut until it is close to its chord and to its parabola.
  ERGO_HD PieceAnswer operator()(const PathPiece& p) {
    // Maximum distance of a piece from its chord (stray), as a fraction of the radius of a mesh
    // that it comes near.
    constexpr double fine = 0.02;
    // Maximum error of the piece's parabola, also as a fraction of the mesh's radius. A smaller
    // limit leads to more pieces. A larger limit leads to more triangles that only the path itself,
    // not the parabola, can exclude.
    constexpr double finest = 3e-4;
    const double stray = p.stray();
    bool near = false;
    for (int i = 0; i < scene.count; ++i) {
      const PlacedMesh& mesh = scene.meshes[i];
      if (!mesh.retarded && !passes(mesh, p, stray)) {
        continue;
      }
      const PathPiece own = in(i).piece(p);
      const double own_stray = own.stray();
      const double reach = mesh.tree.radius + own_stray;
      if (distance_from_segment(mesh.tree.middle, own.from, own.to) <= reach) {
        near = true;
        if (own_stray > fine * mesh.tree.radius ||
            parabola_of(own, in(i), mesh.tree.radius).off > finest * mesh.tree.radius) {
          return PieceAnswer::cut;
        }
      }
    }
    return near && find(p, stray) ? PieceAnswer::stop : PieceAnswer::finish;
  }

  //! Finds the first triangle that a piece crosses. The piece must be close to its chord.
  ERGO_HD bool find(const PathPiece& p, double stray) {
    double first_h = p.to_h + (p.to_h - p.from_h);
    for (int i = 0; i < scene.count; ++i) {
      const PlacedMesh& mesh = scene.meshes[i];
      if (!mesh.retarded && !passes(mesh, p, stray)) {
        continue;
      }
      const PathInMesh<Order, Parts> path = in(i);
      const PathPiece own = path.piece(p);
      PieceCrossings<PathInMesh<Order, Parts>> crossings = {path, own,     parabola_of(own, path, mesh.tree.radius),
                                                            i,    first_h, hit};
      search_in_parts(mesh.tree, own.stray(), crossings);
      first_h = crossings.first_h;
      hit = crossings.hit;
    }
    found_h = first_h;
    return hit.mesh >= 0;
  }

  //! Searches a piece's triangles part by part, from its beginning. The parts bend less than the
  //! piece, and those after the first crossing need no search.
  template <class Crossings>
  ERGO_HD static void search_in_parts(const TriangleTree& tree, double stray, Crossings& crossings) {
    constexpr int parts = 4;
    const double margin = stray / (parts * parts) + crossings.parabola.off + 1e-6 * tree.radius;
    Vector3<double> from = crossings.parabola.from;
    for (int part = 1; part <= parts && (part == 1 || crossings.first_s() * parts > part - 1); ++part) {
      const Vector3<double> to = crossings.parabola.at(static_cast<double>(part) / parts);
      visit_triangles(tree, from, to, margin, crossings);
      from = to;
    }
  }

  //! Finds the first triangle on the step's path. Returns false if there is none.
  ERGO_HD bool run() {
    visit_pieces(
        step.length, 1e-9 * scene.max_r, even_enough, [this](double h) { return step.point(h); }, *this);
    if (hit.mesh < 0) {
      return false;
    }
    hit.point = step.point(found_h);
    hit.delay = step.delay(found_h);
    hit.time = step.start + found_h / step.scale;
    hit.u_rate = step.scale * series_rate(step.series.u, found_h);
    hit.polar_momentum = step.polar_momentum(found_h);
    return true;
  }
};

}  // namespace detail

}  // namespace ERGO_TARGET
}  // namespace ergodome
