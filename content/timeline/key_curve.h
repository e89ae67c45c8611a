#pragma once

#include <cstddef>
#include <functional>

#include "content/timeline/timeline.h"

namespace ergodome {

//! Times and easing of a key: when the curve arrives at it and when it leaves (later, if the key is
//! held), and the easing between this key and the next.
struct CurveKey {
  double arrive_s;
  double leave_s;
  Ease ease;
};

//! Rises from 0 to 1 on [0, 1]; its first and second derivative are zero at both ends.
inline double eased(double s) { return s * s * s * (10.0 + s * (6.0 * s - 15.0)); }

//! The first and second derivative by time of a curve at a key.
struct KeyMotion {
  double rate = 0.0;    //!< first derivative [1/s]
  double change = 0.0;  //!< second derivative [1/s²]
};

//! The straight line between two keys.
struct Chord {
  double rate;    //!< slope of the line [1/s]
  double span_s;  //!< duration between the keys [s]; positive
};

//! How the curve between two keys begins or ends.
enum class SpanEnd {
  rest,      //!< the first and second derivatives by time are 0
  shared,    //!< the derivatives by time equal those on the other side of the key
  straight,  //!< the slope of the neighboring linear span, limited against overshoot
  //! Not eased at this end: the derivatives are those of a cubic t³ at t = 1, where it is fastest.
  at_speed
};

//! Both ends of a span.
struct SpanEnds {
  SpanEnd begin;
  SpanEnd end;
};

//! Returns how the span from key `i` to the next one begins and ends. There are `count` keys, and
//! `key(i)` returns the one at index `i`.
//!
//! Curves rest at the first and the last key, where a key is held, where Ease::in leaves and
//! Ease::out arrives, and next to a jump. Exceptions, at the first key, the last key and a jump:
//! with Ease::out a curve begins, and with Ease::in it ends, at its full speed (SpanEnd::at_speed).
SpanEnds span_ends(std::size_t count, std::size_t i, const std::function<CurveKey(std::size_t)>& key);

//! Returns the two derivatives by time that both spans at a key share: those of the parabola
//! through it and its neighbors, limited so that neither span reverses or overshoots its other key.
KeyMotion shared_motion(const Chord& before, const Chord& after);

//! Returns the two derivatives by time at the beginning of a span with chord `own`; `before` is the
//! chord on the other side of the key.
KeyMotion motion_at_begin(SpanEnd end, const Chord& before, const Chord& own);

//! Returns the two derivatives by time at the end of a span with chord `own`; `after` is the chord
//! on the other side of the key.
KeyMotion motion_at_end(SpanEnd end, const Chord& own, const Chord& after);

//! Returns the value, at t in [0, 1], of the quintic from `from` to `to` in `span_s` with these
//! derivatives at its ends. With those that the functions above return it is monotonic, because its
//! Bernstein coefficients are.
double quintic(double from, double to, double span_s, const KeyMotion& begin, const KeyMotion& end, double t);

}  // namespace ergodome
