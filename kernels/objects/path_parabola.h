#pragma once

#include "kernels/objects/path_step.h"
#include "kernels/objects/placed_mesh.h"
#include "kernels/objects/triangle_tree.h"

// Pieces of paths as parabolas, which exclude triangles that a piece cannot meet without another
// evaluation of its series.
namespace ergodome::inline ERGO_TARGET {

//! A short piece of a path, and how far it may stray from its chord.
struct PathPiece {
  double from_h, to_h;
  Vector3<double> from, middle, to;

  ERGO_HD double middle_h() const { return 0.5 * (from_h + to_h); }
  ERGO_HD double chord() const { return ::sqrt(dot(to - from, to - from)); }
  //! Returns the stray, an upper bound of the path's distance from its chord: twice the distance of
  //! the piece's middle from the chord's middle, across the chord. A displacement along the chord
  //! counts only beyond a quarter of the chord's length, where the path turns back.
  ERGO_HD double stray() const {
    const Vector3<double> bow = middle - 0.5 * (from + to);
    const double along = unevenness();
    const Vector3<double> aside = bow - along * (to - from);
    return 2.0 * (::sqrt(dot(aside, aside)) + ::fmax(::fabs(along) - 0.25, 0.0) * chord());
  }
  //! Returns the displacement of the piece's middle from the chord's, along the chord, as a
  //! fraction of the chord's length.
  ERGO_HD double unevenness() const {
    const Vector3<double> way = to - from;
    const double square = dot(way, way);
    return square > 0.0 ? dot(middle - 0.5 * (from + to), way) / square : 0.0;
  }
};

//! Returns the distance of a point from a segment.
ERGO_HD double distance_from_segment(const Vector3<double>& point, const Vector3<double>& from,
                                     const Vector3<double>& to) {
  const Vector3<double> way = to - from;
  const double square = dot(way, way);
  const double share = square > 0.0 ? ::fmin(1.0, ::fmax(0.0, dot(point - from, way) / square)) : 0.0;
  const Vector3<double> rest = point - (from + share * way);
  return ::sqrt(dot(rest, rest));
}

//! Maximum stray and unevenness of a piece, as fractions of its chord. Up to these, the position of
//! a piece's middle shows how far the piece is from its chord; visit_pieces cuts other pieces.
inline constexpr double straight_enough = 0.1;
inline constexpr double even_enough = 0.15;

//! Answers of the callback of visit_pieces: done with a piece (finish), cut it in two (cut), or
//! skip all others (stop). visit_pieces cuts a step's path into pieces and calls each(piece) in
//! order. Pieces that bend are cut before the call; none is cut more than about twenty times.
enum class PieceAnswer { finish, cut, stop };

template <class Position, class Each>
ERGO_HD void visit_pieces(double length, double smallest_chord, double max_unevenness, const Position& position,
                          Each&& each) {
  constexpr int deepest = 24;
  PathPiece waiting[deepest + 1];
  int count = 0;
  const auto piece = [&](double from_h, const Vector3<double>& from, double to_h, const Vector3<double>& to) {
    return PathPiece{from_h, to_h, from, position(0.5 * (from_h + to_h)), to};
  };
  const double half = 0.5 * length;
  const Vector3<double> middle = position(half);
  waiting[count++] = piece(half, middle, length, position(length));
  waiting[count++] = piece(0.0, position(0.0), half, middle);
  while (count > 0) {
    const PathPiece p = waiting[--count];
    const double chord = p.chord();
    const bool bent = p.stray() > straight_enough * chord + smallest_chord ||
                      (::fabs(p.unevenness()) > max_unevenness && chord > smallest_chord);
    const bool may_cut = count + 2 <= deepest + 1;
    const PieceAnswer answer = bent && may_cut ? PieceAnswer::cut : each(p);
    if (answer == PieceAnswer::stop) {
      return;
    }
    if (answer == PieceAnswer::cut && may_cut) {
      const double h = p.middle_h();
      waiting[count++] = piece(h, p.middle, p.to_h, p.to);
      waiting[count++] = piece(p.from_h, p.from, h, p.middle);
    }
  }
}

//! The parabola through a piece's ends and its middle, P(s) for s from 0 to 1.
struct PathParabola {
  Vector3<double> from, middle, to;
  double off;      //!< estimated maximum distance between path and parabola at the same s
  double fastest;  //!< upper limit of |dP/ds|

  ERGO_HD Vector3<double> at(double s) const {
    return ((1.0 - s) * (1.0 - 2.0 * s)) * from + (4.0 * s * (1.0 - s)) * middle + (s * (2.0 * s - 1.0)) * to;
  }
};

//! Returns the parabola of a piece; path(h) returns a position. The difference between path and
//! parabola, due to cubic and higher terms, is largest near the quarters, where it is measured.
//! `off` is twice that, plus the rounding error of a path of size `radius`.
template <class Path>
ERGO_HD PathParabola parabola_of(const PathPiece& p, const Path& path, double radius) {
  PathParabola parabola = {p.from, p.middle, p.to, 0.0, 0.0};
  double square = 0.0;
  for (int i = 0; i < 2; ++i) {
    const double s = i == 0 ? 0.25 : 0.75;
    const Vector3<double> rest = path(p.from_h + s * (p.to_h - p.from_h)) - parabola.at(s);
    square = ::fmax(square, dot(rest, rest));
  }
  parabola.off = 2.0 * ::sqrt(square) + 1e-9 * radius;
  const Vector3<double> first = 4.0 * p.middle - 3.0 * p.from - p.to;
  const Vector3<double> last = 3.0 * p.to - 4.0 * p.middle + p.from;
  parabola.fastest = ::sqrt(::fmax(dot(first, first), dot(last, last)));
  return parabola;
}

//! A triangle's plane relative to a piece: f = normal · (P(s) - corner) at s = 0, 1/2 and 1.
struct PlaneOnPiece {
  const TriangleSides& sides;
  Vector3<double> normal;  //!< with a length of twice the triangle's area
  double at_from, at_middle, at_to;
};

namespace detail {

//! Returns whether a point near the plane is within a triangle, or outside of it by at most `slack`
//! [the mesh's unit].
ERGO_HD bool is_within(const PlaneOnPiece& plane, const Vector3<double>& point, double slack) {
  const TriangleSides& sides = plane.sides;
  const Vector3<double> from_corner = point - sides.corner;
  const double area = dot(plane.normal, plane.normal);
  const double weight_1 = dot(cross(from_corner, sides.side_2), plane.normal);
  const double weight_2 = dot(cross(sides.side_1, from_corner), plane.normal);
  const double longest = ::fmax(dot(sides.side_1, sides.side_1), dot(sides.side_2, sides.side_2));
  // A weight changes by at most a displacement times the opposite side over the normal, and no side
  // is longer than twice the longer of these two.
  const double allowed = 1e-8 * area + 2.0 * slack * ::sqrt(longest * area);
  return weight_1 >= -allowed && weight_2 >= -allowed && weight_1 + weight_2 <= area + allowed;
}

}  // namespace detail

//! Returns whether a path may cross a triangle before `first_s`, according to its parabola. Returns
//! false only if it certainly does not, provided that `off` is right. A path that grazes the plane
//! may cross it.
ERGO_HD bool may_cross(const PathParabola& path, const PlaneOnPiece& plane, double first_s) {
  const double reach = path.off * ::sqrt(dot(plane.normal, plane.normal));
  const double bow = 2.0 * (plane.at_from + plane.at_to) - 4.0 * plane.at_middle;
  const double minimum = ::fmin(::fabs(plane.at_from), ::fmin(::fabs(plane.at_middle), ::fabs(plane.at_to)));
  const bool below = plane.at_from < 0.0 && plane.at_middle < 0.0 && plane.at_to < 0.0;
  const bool above = plane.at_from > 0.0 && plane.at_middle > 0.0 && plane.at_to > 0.0;
  // Between neighboring points, the parabola deviates from their chord by at most |bow| / 16, where
  // `bow` is its quadratic coefficient.
  if ((below || above) && minimum > reach + 0.0625 * ::fabs(bow)) {
    return false;
  }
  const double slope = plane.at_to - plane.at_from - bow;
  const double square = slope * slope - 4.0 * bow * plane.at_from;
  if (!(square > 0.0)) {
    return !(::fabs(square) > 8.0 * reach * ::fabs(bow));
  }
  const double root = ::sqrt(square);
  // Maximum difference in s between the path's crossing and the parabola's.
  const double slip = 2.0 * reach / root;
  if (!(slip < 0.25) || square < 4.0 * reach * ::fabs(bow)) {
    return true;
  }
  const double half = -0.5 * (slope + ::copysign(root, slope));
  const double slack = path.off + slip * path.fastest;
  const auto crosses_at = [&](double s) {
    return s >= -slip && s <= 1.0 + slip && s <= first_s + slip && detail::is_within(plane, path.at(s), slack);
  };
  return (bow != 0.0 && crosses_at(half / bow)) || (half != 0.0 && crosses_at(plane.at_from / half));
}

}  // namespace ergodome::inline ERGO_TARGET
