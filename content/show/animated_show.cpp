#include "content/show/animated_show.h"

#include <algorithm>

#include "content/camera/key_curve.h"

namespace ergodome {

namespace {

using NumberKeys = std::vector<NumberKey>;

Chord chord(const NumberKeys& keys, std::size_t i) {
  const double span_s = keys[i + 1].time_s - keys[i].time_s;
  return {(keys[i + 1].value - keys[i].value) / span_s, span_s};
}

//! Returns the value between key `i` and the next one, t in [0, 1).
double value_between(const NumberKeys& keys, std::size_t i, double t) {
  const double from = keys[i].value;
  const double to = keys[i + 1].value;
  if (keys[i].ease == Ease::hold) {
    return from;
  }
  if (keys[i].ease == Ease::linear) {
    return from + (to - from) * t;
  }
  const SpanEnds ends = span_ends(keys.size(), i, [&](std::size_t k) {
    return CurveKey{keys[k].time_s, keys[k].time_s, keys[k].ease};
  });
  const Chord own = chord(keys, i);
  return quintic(from, to, own.span_s, motion_at_begin(ends.begin, i > 0 ? chord(keys, i - 1) : own, own),
                 motion_at_end(ends.end, own, i + 2 < keys.size() ? chord(keys, i + 1) : own), t);
}

//! Sets each animated number to `value(animation)`.
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

double value_at(const Animation& animation, double time_s) {
  const NumberKeys& keys = animation.keys;
  const auto after =
      std::upper_bound(keys.begin(), keys.end(), time_s, [](double t, const NumberKey& key) { return t < key.time_s; });
  if (after == keys.begin()) {
    return keys.front().value;
  }
  if (after == keys.end()) {
    return keys.back().value;
  }
  const auto i = static_cast<std::size_t>(after - keys.begin()) - 1;
  return value_between(keys, i, (time_s - keys[i].time_s) / (keys[i + 1].time_s - keys[i].time_s));
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
  const auto moves = [](const ObjectSettings& object) { return object.orbit || !object.way[0].keys.empty(); };
  return !show.timeline.animations.empty() || (show.disk && show.disk->pattern != DiskPattern::none) ||
         std::ranges::any_of(show.objects, moves);
}

double spin_at(const Show& show, double time_s) {
  const Animation* const animation = find_animation(show, "hole.spin");
  return animation != nullptr ? value_at(*animation, time_s) : show.spin;
}

NumberLimits range_of(const Animation& animation) {
  const auto [least, greatest] = std::ranges::minmax(animation.keys, {}, &NumberKey::value);
  return {least.value, greatest.value};
}

Show show_at_least(Show show) {
  put_values(show, [](const Animation& animation) { return range_of(animation).least; });
  return show;
}

Show show_at_most(Show show) {
  put_values(show, [](const Animation& animation) { return range_of(animation).greatest; });
  return show;
}

}  // namespace ergodome
