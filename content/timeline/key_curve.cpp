#include "content/timeline/key_curve.h"

#include <algorithm>
#include <cmath>

namespace ergodome {

namespace {

// Constraints for a span of length h that rises at the mean rate d (falling spans are mirrored)
// from the value p, and begins with the first derivative m and the second derivative s by time. Its
// first Bernstein coefficients are p, p + h m / 5 and p + 2 h m / 5 + h² s / 20. They increase, and
// stay in the first half of the span's rise, if m ≥ 0 and -4 m / h ≤ s ≤ 10 d / h - 8 m / h. At the
// end of a span the same holds with the sign of s reversed. The two spans at a key share m and s.
// An s that satisfies both exists if m ≤ 2.5 d for both spans, and if m is at most 1.25 times the
// slope of the parabola.
constexpr double steepest = 2.5;
//! Maximum slope, relative to the span's mean rate, at an end with s = 0.
constexpr double steepest_straight = 1.25;

double same_sign(double value, double as) { return std::copysign(value, as); }

//! Returns the two derivatives by time at the end of a span (`side` 1), or at its beginning (-1),
//! if the curve has full speed there and rests at the other end: those of the cubic t³.
KeyMotion unslowed(const Chord& own, double side) { return {3.0 * own.rate, side * 6.0 * own.rate / own.span_s}; }

KeyMotion straight_on(const Chord& other, const Chord& own) {
  if (other.rate * own.rate <= 0.0) {
    return {};
  }
  return {same_sign(std::min(std::abs(other.rate), steepest_straight * std::abs(own.rate)), own.rate), 0.0};
}

//! Allowed range of a second derivative by time.
struct Limits {
  double minimum;
  double maximum;
};

//! Returns the allowed range of the second derivative for a span that begins with the slope m.
Limits limits_at_begin(double m, const Chord& way) {
  const double back = -4.0 * m / way.span_s;
  const double forth = (10.0 * way.rate - 8.0 * m) / way.span_s;
  return {std::min(back, forth), std::max(back, forth)};
}

//! Returns the allowed range of the second derivative for a span that ends with the slope m.
Limits limits_at_end(double m, const Chord& way) {
  const double back = 4.0 * m / way.span_s;
  const double forth = (8.0 * m - 10.0 * way.rate) / way.span_s;
  return {std::min(back, forth), std::max(back, forth)};
}

//! Returns true if the curve rests at an inner key because it is held or eased; `before` is the key
//! before it.
bool rests_between(const CurveKey& before, const CurveKey& key) {
  const bool held = key.leave_s > key.arrive_s;
  return held || key.ease == Ease::in || key.ease == Ease::in_out || before.ease == Ease::out ||
         before.ease == Ease::in_out;
}

}  // namespace

SpanEnds span_ends(std::size_t count, std::size_t i, const std::function<CurveKey(std::size_t)>& key) {
  const CurveKey from = key(i);
  SpanEnds ends = {SpanEnd::shared, SpanEnd::shared};
  if (i == 0 || key(i - 1).ease == Ease::hold) {
    ends.begin = from.ease == Ease::out ? SpanEnd::at_speed : SpanEnd::rest;
  } else if (rests_between(key(i - 1), from)) {
    ends.begin = SpanEnd::rest;
  } else if (key(i - 1).ease == Ease::linear) {
    ends.begin = SpanEnd::straight;
  }
  if (i + 2 == count || key(i + 1).ease == Ease::hold) {
    ends.end = from.ease == Ease::in ? SpanEnd::at_speed : SpanEnd::rest;
  } else if (rests_between(from, key(i + 1))) {
    ends.end = SpanEnd::rest;
  } else if (key(i + 1).ease == Ease::linear) {
    ends.end = SpanEnd::straight;
  }
  return ends;
}

KeyMotion shared_motion(const Chord& before, const Chord& after) {
  const double both_s = before.span_s + after.span_s;
  KeyMotion motion;
  if (before.rate * after.rate > 0.0) {
    const double parabola = (after.span_s / both_s) * before.rate + (before.span_s / both_s) * after.rate;
    const double limit = steepest * std::min(std::abs(before.rate), std::abs(after.rate));
    motion.rate = same_sign(std::min(std::abs(parabola), limit), parabola);
  } else if (before.rate == 0.0 || after.rate == 0.0) {
    return motion;
  }
  const Limits one = limits_at_end(motion.rate, before);
  const Limits other = limits_at_begin(motion.rate, after);
  const double minimum = std::max(one.minimum, other.minimum);
  const double maximum = std::min(one.maximum, other.maximum);
  const double parabola = 2.0 * (after.rate - before.rate) / both_s;
  motion.change = minimum <= maximum ? std::clamp(parabola, minimum, maximum) : 0.0;
  return motion;
}

KeyMotion motion_at_begin(SpanEnd end, const Chord& before, const Chord& own) {
  switch (end) {
    case SpanEnd::shared:
      return shared_motion(before, own);
    case SpanEnd::straight:
      return straight_on(before, own);
    case SpanEnd::at_speed:
      return unslowed(own, -1.0);
    case SpanEnd::rest:
      break;
  }
  return {};
}

KeyMotion motion_at_end(SpanEnd end, const Chord& own, const Chord& after) {
  switch (end) {
    case SpanEnd::shared:
      return shared_motion(own, after);
    case SpanEnd::straight:
      return straight_on(after, own);
    case SpanEnd::at_speed:
      return unslowed(own, 1.0);
    case SpanEnd::rest:
      break;
  }
  return {};
}

double quintic(double from, double to, double span_s, const KeyMotion& begin, const KeyMotion& end, double t) {
  const double way = to - from;
  // Bernstein coefficients of the quintic, relative to the first one.
  const double c1 = span_s * begin.rate / 5.0;
  const double c2 = 2.0 * c1 + span_s * span_s * begin.change / 20.0;
  const double c4 = way - span_s * end.rate / 5.0;
  const double c3 = way - 2.0 * span_s * end.rate / 5.0 + span_s * span_s * end.change / 20.0;
  const double s = 1.0 - t;
  const double sum = t * (5.0 * s * s * s * s * c1 +
                          t * (10.0 * s * s * s * c2 + t * (10.0 * s * s * c3 + t * (5.0 * s * c4 + t * way))));
  // Prevents rounding errors from leaving the range between the two values.
  return std::clamp(from + sum, std::min(from, to), std::max(from, to));
}

}  // namespace ergodome
