#pragma once

#include "kernels/mesh/triangle_tree.h"
#include "kernels/near_field/radial_fate.h"
#include "kernels/near_field/series_search.h"

namespace ergodome {

//! A mesh in space: its point p stands at position + size · rows · p, pseudo-Cartesian: x = r sinθ cosφ, y = r sinθ sinφ, z = r cosθ [M].
struct PlacedMesh {
  TriangleTree tree;
  Vector3<double> position;
  double rows[3][3];  //!< a rotation
  double size;        //!< M in a unit of the mesh
};

//! Meshes among which a ray looks for the first one on its way.
struct MeshScene {
  const PlacedMesh* meshes;
  int count;
  double least_r;     //!< no mesh reaches farther in; outside the horizon [M]
  double greatest_r;  //!< nor farther out [M]
};

//! How far rays are followed, and how exactly.
struct MeshLimits {
  double tolerance;  //!< local error of the path
  int step_limit;
};

//! Where light leaves a mesh.
struct MeshHit {
  int mesh = -1;            //!< none
  std::uint32_t place = 0;  //!< of the triangle in the tree
  double weight_1 = 0.0;    //!< of the second and the third corner; the first has the rest
  double weight_2 = 0.0;
  Vector3<double> point;  //!< pseudo-Cartesian [M]
  double u_rate = 0.0;    //!< du/dλ, backwards in time
  double delay = 0.0;     //!< coordinate time from there to the camera [M]; with azimuth_and_delay alone
};

inline namespace ERGO_TARGET {

//! A point in the unit of a mesh.
ERGO_HD Vector3<double> in_mesh(const PlacedMesh& mesh, const Vector3<double>& point) {
  const Vector3<double> d = (1.0 / mesh.size) * (point - mesh.position);
  const auto& rows = mesh.rows;
  return {rows[0][0] * d.x + rows[1][0] * d.y + rows[2][0] * d.z,
          rows[0][1] * d.x + rows[1][1] * d.y + rows[2][1] * d.z,
          rows[0][2] * d.x + rows[1][2] * d.y + rows[2][2] * d.z};
}

namespace detail {

//! A ray between two steps of its series.
template <int Order, NearParts Parts>
struct MeshStep {
  NearSeries<Order, double, Parts> series;
  Vector3<double> axes[2];  //!< where m's x and y point, before frame dragging
  double least_u;           //!< beyond it nothing stands

  ERGO_HD Vector3<double> point(double h) const {
    const double drag = series_value(series.drag, h);
    const double cosine = ::cos(drag);
    const double sine = ::sin(drag);
    const double x = series_value(series.x, h);
    const double y = series_value(series.y, h);
    const double along = cosine * x - sine * y;
    const double across = sine * x + cosine * y;
    const double r = 1.0 / ::fmax(series_value(series.u, h), least_u);
    return r * (along * axes[0] + across * axes[1] + Vector3<double>{0.0, 0.0, series_value(series.z, h)});
  }
};

//! A short piece of a path, and how far it may stray from its chord.
struct PathPiece {
  double from_h, to_h;
  Vector3<double> from, middle, to;

  ERGO_HD double chord() const { return ::sqrt(dot(to - from, to - from)); }
  //! Twice the sagitta: pieces are short, and close to parabolas.
  ERGO_HD double stray() const {
    const Vector3<double> bow = middle - 0.5 * (from + to);
    return 2.0 * ::sqrt(dot(bow, bow));
  }
};

//! Distance of a point from a segment.
ERGO_HD double distance_from_segment(const Vector3<double>& point, const Vector3<double>& from,
                                     const Vector3<double>& to) {
  const Vector3<double> way = to - from;
  const double square = dot(way, way);
  const double share = square > 0.0 ? ::fmin(1.0, ::fmax(0.0, dot(point - from, way) / square)) : 0.0;
  const Vector3<double> rest = point - (from + share * way);
  return ::sqrt(dot(rest, rest));
}

//! The path's distance from a triangle's plane, in units of twice the triangle's area.
template <int Order, NearParts Parts>
struct PlaneDistance {
  const MeshStep<Order, Parts>& step;
  const PlacedMesh& mesh;
  Vector3<double> corner;
  Vector3<double> normal;

  ERGO_HD double of(const Vector3<double>& point) const { return dot(normal, in_mesh(mesh, point) - corner); }
  ERGO_HD double operator()(double h) const { return of(step.point(h)); }
};

//! Where a function with values of opposite sign at both ends is zero, by the Illinois rule.
template <class Function>
ERGO_HD double zero_between(const Function& f, double low, double high, double at_low, double at_high) {
  constexpr int most_rounds = 40;
  int side = 0;
  double h = low;
  for (int round = 0; round < most_rounds; ++round) {
    h = low + (high - low) * (at_low / (at_low - at_high));
    const double value = f(h);
    if (value == 0.0 || ::fabs(high - low) <= 1e-15) {
      break;
    }
    if ((value < 0.0) == (at_high < 0.0)) {
      if (::fabs(high - h) <= 1e-15 * ::fabs(h)) {
        break;
      }
      high = h;
      at_high = value;
      at_low *= side == -1 ? 0.5 : 1.0;
      side = -1;
    } else {
      if (::fabs(h - low) <= 1e-15 * ::fabs(h)) {
        break;
      }
      low = h;
      at_low = value;
      at_high *= side == 1 ? 0.5 : 1.0;
      side = 1;
    }
  }
  return h;
}

//! Looks at triangles that a piece may cross, and keeps the first.
template <int Order, NearParts Parts>
struct PieceCrossings {
  const MeshStep<Order, Parts>& step;
  const PathPiece& piece;
  const PlacedMesh& mesh;
  int index;
  double first_h;
  MeshHit hit;

  ERGO_HD void operator()(std::uint32_t place) {
    const TriangleSides sides = triangle_sides(mesh.tree, place);
    const PlaneDistance<Order, Parts> f = {step, mesh, sides.corner, cross(sides.side_1, sides.side_2)};
    const double at_from = f.of(piece.from);
    const double at_to = f.of(piece.to);
    if ((at_from < 0.0) != (at_to < 0.0)) {
      keep(f, sides, place, zero_between(f, piece.from_h, piece.to_h, at_from, at_to));
      return;
    }
    // A path that bends may pass the plane and come back: the parabola through three points says where it would turn.
    const double bow = 2.0 * (at_from + at_to) - 4.0 * f.of(piece.middle);
    const double share = bow != 0.0 ? 0.5 - 0.5 * (at_to - at_from) / bow : -1.0;
    if (!(share > 0.0 && share < 1.0)) {
      return;
    }
    const double turn = piece.from_h + share * (piece.to_h - piece.from_h);
    const double at_turn = f(turn);
    if ((at_turn < 0.0) != (at_from < 0.0)) {
      keep(f, sides, place, zero_between(f, piece.from_h, turn, at_from, at_turn));
      keep(f, sides, place, zero_between(f, turn, piece.to_h, at_turn, at_to));
    }
  }

  //! Keeps the crossing of a triangle's plane, if it lies within the triangle and is the first so far.
  ERGO_HD void keep(const PlaneDistance<Order, Parts>& f, const TriangleSides& sides, std::uint32_t place, double h) {
    if (!(h < first_h)) {
      return;
    }
    const Vector3<double> point = step.point(h);
    const Vector3<double> from_corner = in_mesh(mesh, point) - sides.corner;
    const double area = dot(f.normal, f.normal);
    const double weight_1 = dot(cross(from_corner, sides.side_2), f.normal) / area;
    const double weight_2 = dot(cross(sides.side_1, from_corner), f.normal) / area;
    // Triangles that share a side leave no gap.
    constexpr double seam = 1e-9;
    if (weight_1 >= -seam && weight_2 >= -seam && weight_1 + weight_2 <= 1.0 + seam) {
      first_h = h;
      hit = {index, place, weight_1, weight_2, point, 0.0, 0.0};
    }
  }
};

//! Looks through a step, piece by piece.
template <int Order, NearParts Parts>
struct StepSearch {
  const MeshStep<Order, Parts>& step;
  const MeshScene& scene;
  double found_h = 0.0;
  MeshHit hit;

  ERGO_HD PathPiece piece(double from_h, const Vector3<double>& from, double to_h, const Vector3<double>& to) const {
    return {from_h, to_h, from, step.point(0.5 * (from_h + to_h)), to};
  }

  //! The size of the smallest mesh that a piece may meet; 0: none.
  ERGO_HD double smallest_near(const PathPiece& p, double stray) const {
    double smallest = 0.0;
    for (int i = 0; i < scene.count; ++i) {
      const PlacedMesh& mesh = scene.meshes[i];
      const double radius = mesh.size * mesh.tree.radius;
      const bool near = distance_from_segment(mesh.position, p.from, p.to) <= radius + stray;
      smallest = near && (smallest == 0.0 || radius < smallest) ? radius : smallest;
    }
    return smallest;
  }

  //! Finds the first triangle of a piece that strays little.
  ERGO_HD bool find(const PathPiece& p, double stray) {
    double first_h = p.to_h + (p.to_h - p.from_h);
    for (int i = 0; i < scene.count; ++i) {
      const PlacedMesh& mesh = scene.meshes[i];
      if (distance_from_segment(mesh.position, p.from, p.to) <= mesh.size * mesh.tree.radius + stray) {
        PieceCrossings<Order, Parts> crossings = {step, p, mesh, i, first_h, hit};
        const double rounding = 1e-6 * mesh.tree.radius;
        visit_triangles(mesh.tree, in_mesh(mesh, p.from), in_mesh(mesh, p.to), stray / mesh.size + rounding, crossings);
        first_h = crossings.first_h;
        hit = crossings.hit;
      }
    }
    found_h = first_h;
    return hit.mesh >= 0;
  }

  //! Finds the first triangle on the step's path from 0 to `length`.
  ERGO_HD bool run(double length) {
    constexpr int deepest = 24;
    // A piece may bend by so much of its length for its middle to tell how far it strays, and by so much of a mesh it looks for.
    constexpr double straight = 0.1;
    constexpr double fine = 0.02;
    PathPiece waiting[deepest + 1];
    int count = 0;
    const double half = 0.5 * length;
    const Vector3<double> middle = step.point(half);
    waiting[count++] = piece(half, middle, length, step.point(length));
    waiting[count++] = piece(0.0, step.point(0.0), half, middle);
    while (count > 0) {
      const PathPiece p = waiting[--count];
      const double stray = p.stray();
      const double smallest = smallest_near(p, stray);
      const bool bent = stray > straight * p.chord() + 1e-9 * scene.greatest_r;
      if (smallest == 0.0 && !bent) {
        continue;
      }
      if ((bent || stray > fine * smallest) && count + 2 <= deepest + 1) {
        const double h = 0.5 * (p.from_h + p.to_h);
        waiting[count++] = piece(h, p.middle, p.to_h, p.to);
        waiting[count++] = piece(p.from_h, p.from, h, p.middle);
        continue;
      }
      if (find(p, stray)) {
        return true;
      }
    }
    return false;
  }
};

}  // namespace detail

//! The first mesh on a ray that is followed backwards from a camera at azimuth φ, with all the ways round the hole. False where the ray met
//! the step limit before it was decided; `hit` is none for light from elsewhere.
//!
//! Paths are Taylor series; pieces of them that come near a mesh are searched for triangles as parabolas would be, and a crossing is a zero of
//! the series itself: outlines are as exact as the path. A path that grazes a plane twice within a fiftieth of its mesh is seen by the
//! parabola through the piece.
template <int Order, NearParts Parts>
ERGO_HD bool trace_meshes(double spin, double cosine_phi, double sine_phi, const NearRay<double>& ray,
                          const MeshScene& scene, const MeshLimits& limits, MeshHit& hit) {
  hit = MeshHit{};
  const RadialFate<double> fate = radial_fate(spin, ray);
  const double scale = safe_sqrt(::fmax(ray.polar_constant, 0.0)) + ::fmax(::fabs(ray.energy), 1.0);
  const detail::NearCoefficients<double> coefficients = detail::near_coefficients(spin, ray, 1.0 / scale);
  const double outermost = 1.0 / scene.greatest_r;
  const double innermost = 1.0 / scene.least_r;
  detail::MeshStep<Order, Parts> step;
  step.axes[0] = {cosine_phi, sine_phi, 0.0};
  step.axes[1] = {-sine_phi, cosine_phi, 0.0};
  step.least_u = 0.5 * ::fmin(outermost, ray.u);
  detail::start_series(ray, 1.0 / scale, step.series);
  for (int count = 0; count < limits.step_limit; ++count) {
    auto& s = step.series;
    if ((keeps_inwards(fate, s.u[0], s.u[1]) && s.u[0] >= innermost) ||
        (keeps_outwards(fate, s.u[0], s.u[1]) && s.u[0] <= outermost)) {
      return true;
    }
    detail::expand_near(spin, ray, coefficients, s);
    const double length = detail::near_step(s, scale, limits.tolerance);
    detail::StepSearch<Order, Parts> search = {step, scene, 0.0, {}};
    if (search.run(length)) {
      hit = search.hit;
      hit.u_rate = series_rate(s.u, search.found_h) * scale;
      if constexpr (has_delay(Parts)) {
        hit.delay = series_value(s.delay, search.found_h);
      }
      return true;
    }
    detail::move_series(s, length);
  }
  return false;
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
