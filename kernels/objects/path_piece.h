#pragma once

#include "kernels/objects/path_step.h"
#include "kernels/objects/placed_mesh.h"

// Cuts steps of paths into pieces that are close to parabolas.
namespace ergodome::inline ERGO_TARGET {

//! A short piece of a path, and how far it may stray from its chord.
struct PathPiece {
  double from_h, to_h;
  Vector3<double> from, middle, to;

  ERGO_HD double middle_h() const { return 0.5 * (from_h + to_h); }
  ERGO_HD double chord() const { return ::sqrt(dot(to - from, to - from)); }
  //! Returns twice the sagitta, since pieces are short and close to parabolas. A displacement along
  //! the chord only counts if the path turns back there.
  ERGO_HD double stray() const {
    const Vector3<double> bow = middle - 0.5 * (from + to);
    const double along = unevenness();
    const Vector3<double> aside = bow - along * (to - from);
    return 2.0 * (::sqrt(dot(aside, aside)) + ::fmax(::fabs(along) - 0.25, 0.0) * chord());
  }
  //! Returns the displacement of the piece's middle from the chord's, along the chord, as a
  //! fraction of its length.
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

//! Maximum bend and unevenness of a piece, as fractions of its length, for which its middle shows
//! how far it strays.
inline constexpr double straight_enough = 0.1;
inline constexpr double even_enough = 0.15;

//! Answers of the callback of visit_pieces: done with a piece (finish), cut it in two (cut), or
//! skip all others (stop). visit_pieces cuts a step's path into pieces and calls each(piece) in
//! order. Pieces that bend are cut before the call; none is cut more than about twenty times.
enum class PieceAnswer { finish, cut, stop };

template <class Place, class Each>
ERGO_HD void visit_pieces(double length, double smallest_chord, double most_uneven, const Place& place, Each&& each) {
  constexpr int deepest = 24;
  PathPiece waiting[deepest + 1];
  int count = 0;
  const auto piece = [&](double from_h, const Vector3<double>& from, double to_h, const Vector3<double>& to) {
    return PathPiece{from_h, to_h, from, place(0.5 * (from_h + to_h)), to};
  };
  const double half = 0.5 * length;
  const Vector3<double> middle = place(half);
  waiting[count++] = piece(half, middle, length, place(length));
  waiting[count++] = piece(0.0, place(0.0), half, middle);
  while (count > 0) {
    const PathPiece p = waiting[--count];
    const double chord = p.chord();
    const bool bent = p.stray() > straight_enough * chord + smallest_chord ||
                      (::fabs(p.unevenness()) > most_uneven && chord > smallest_chord);
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

}  // namespace ergodome::inline ERGO_TARGET
