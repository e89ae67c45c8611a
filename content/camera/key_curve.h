#pragma once

#include <cstddef>
#include <functional>

#include "content/timeline/timeline.h"

namespace ergodome {

//! A key as a curve sees it: when the way to it ends, when the way from it begins (later where it is held), and how that way goes.
struct CurveKey {
  double arrive_s;
  double leave_s;
  Ease ease;
};

//! From 0 to 1 on [0, 1], with two derivatives of 0 at both ends.
inline double eased(double s) { return s * s * s * (10.0 + s * (6.0 * s - 15.0)); }

//! What a curve does at a key.
struct KeyMotion {
  double rate = 0.0;    //!< first derivative [1/s]
  double change = 0.0;  //!< second derivative [1/s²]
};

//! The straight way between two keys.
struct Chord {
  double rate;    //!< [1/s]
  double span_s;  //!< more than 0
};

//! How the way between two keys begins or ends.
enum class SpanEnd {
  rest,      //!< both derivatives are 0
  shared,    //!< as the way on the other side of the key
  straight,  //!< at the speed of the straight way there, as far as that does not overshoot
  at_speed   //!< without easing: as t³ ends
};

//! Both ends of a way.
struct SpanEnds {
  SpanEnd begin;
  SpanEnd end;
};

//! How the way from key `i` to the next one begins and ends. `count` keys; `key(i)` may be asked for any of them.
//!
//! Curves rest at the first and the last key, where one is held, where Ease::in leaves and Ease::out arrives, and beside a jump.
SpanEnds span_ends(std::size_t count, std::size_t i, const std::function<CurveKey(std::size_t)>& key);

//! The two derivatives that both ways at a key share: of the parabola through it and its neighbours, limited so that neither way turns
//! back or passes its other key.
KeyMotion shared_motion(const Chord& before, const Chord& after);

//! The motion at the beginning of a way with chord `own`; `before` is the chord on the other side of the key.
KeyMotion motion_at_begin(SpanEnd end, const Chord& before, const Chord& own);

//! The same at its end, with the chord `after`.
KeyMotion motion_at_end(SpanEnd end, const Chord& own, const Chord& after);

//! The quintic from `from` to `to` in `span_s` with these motions at its ends, at t in [0, 1]. With the motions above it runs from one to
//! the other without turning back: the coefficients of its Bernstein form do, and the curve follows them.
double quintic(double from, double to, double span_s, const KeyMotion& begin, const KeyMotion& end, double t);

}  // namespace ergodome
