#include "content/show/animated_show.h"

#include <algorithm>

#include "content/timeline/key_curve.h"

namespace ergodome {

namespace {

using KeyAt = std::function<NumberKey(std::size_t)>;

Chord chord(const KeyAt& key, std::size_t i) {
  const NumberKey from = key(i);
  const NumberKey to = key(i + 1);
  const double span_s = to.time_s - from.time_s;
  return {(to.value - from.value) / span_s, span_s};
}

//! Returns the value between key `i` of `count` and the next one, t in [0, 1).
double value_between(std::size_t count, const KeyAt& key, std::size_t i, double t) {
  const double from = key(i).value;
  const double to = key(i + 1).value;
  if (key(i).ease == Ease::hold) {
    return from;
  }
  if (key(i).ease == Ease::linear) {
    return from + (to - from) * t;
  }
  const SpanEnds ends = span_ends(count, i, [&](std::size_t k) {
    const NumberKey at = key(k);
    return CurveKey{at.time_s, at.time_s, at.ease};
  });
  const Chord own = chord(key, i);
  return quintic(from, to, own.span_s, motion_at_begin(ends.begin, i > 0 ? chord(key, i - 1) : own, own),
                 motion_at_end(ends.end, own, i + 2 < count ? chord(key, i + 1) : own), t);
}

//! Sets each animated number to `value(animation)`. Returns what the changed numbers invalidate.
template <class Value>
NumberChange put_values(Show& show, const Value& value) {
  NumberChange changed;
  for (const Animation& animation : show.timeline.animations) {
    const AnimatableNumber* const number = find_animatable(animation.path);
    if (number == nullptr || animation.keys.empty()) {
      continue;
    }
    const double now = value(animation);
    if (number->get(show) != now) {
      number->put(show, now);
      changed |= number->change;
    }
  }
  return changed;
}

}  // namespace

double value_at(std::size_t count, const KeyAt& key, double time_s) {
  // Finds the first key after the time by bisection.
  std::size_t after = 0;
  for (std::size_t end = count; after < end;) {
    const std::size_t middle = after + (end - after) / 2;
    if (!(time_s < key(middle).time_s)) {
      after = middle + 1;
    } else {
      end = middle;
    }
  }
  if (after == 0) {
    return key(0).value;
  }
  if (after == count) {
    return key(count - 1).value;
  }
  const double from_s = key(after - 1).time_s;
  return value_between(count, key, after - 1, (time_s - from_s) / (key(after).time_s - from_s));
}

double value_at(const Animation& animation, double time_s) {
  return value_at(
      animation.keys.size(), [&](std::size_t i) { return animation.keys[i]; }, time_s);
}

NumberChange animate(Show& show, double time_s) {
  return put_values(show, [&](const Animation& animation) { return value_at(animation, time_s); });
}

Show show_at(Show show, double time_s) {
  animate(show, time_s);
  return show;
}

const Animation* find_animation(const Show& show, std::string_view path) {
  const auto found = std::ranges::find(show.timeline.animations, path, &Animation::path);
  return found != show.timeline.animations.end() ? &*found : nullptr;
}

bool changes_by_itself(const Show& show) {
  const auto moves = [](const ObjectSettings& object) { return object.orbit || !object.keys.empty(); };
  return !show.timeline.animations.empty() || (show.disk && show.disk->pattern != DiskPattern::none) ||
         std::ranges::any_of(show.objects, moves);
}

Spacetime spacetime_at(const Show& show, double time_s) {
  const Animation* const animation = find_animation(show, "hole.spin");
  return Spacetime{animation != nullptr ? value_at(*animation, time_s) : show.spin};
}

NumberLimits range_of(const Animation& animation) {
  const auto [minimum, maximum] = std::ranges::minmax(animation.keys, {}, &NumberKey::value);
  return {minimum.value, maximum.value};
}

Show show_at_least(Show show) {
  put_values(show, [](const Animation& animation) { return range_of(animation).minimum; });
  return show;
}

Show show_at_most(Show show) {
  put_values(show, [](const Animation& animation) { return range_of(animation).maximum; });
  return show;
}

}  // namespace ergodome
