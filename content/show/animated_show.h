#pragma once

#include <cstddef>
#include <functional>

#include "content/show/animatable_number.h"

namespace ergodome {

//! Returns the value of an animated number at a show time; the first key's value before that key,
//! and the last key's value after that one.
//!
//! With Ease::smooth, the curve is C² and does not overshoot its keys
//! (content/timeline/key_curve.h). Other kinds are described at Ease. Times are measured from the
//! preceding key, so late in a show they are as exact as doubles can represent them.
double value_at(const Animation& animation, double time_s);

//! Returns the value at a show time of a number with `count` keys, at least one; `key(i)` returns
//! any of them.
double value_at(std::size_t count, const std::function<NumberKey(std::size_t)>& key, double time_s);

//! Sets every animated number of the show to its value at a show time, and returns what must be
//! updated. A show without animations is not changed; nothing is copied.
NumberChange animate(Show& show, double time_s);

//! Returns a copy of the show with the values at a show time.
Show show_at(Show show, double time_s);

//! Returns the animation of a number, or nullptr.
const Animation* find_animation(const Show& show, std::string_view path);

//! Returns true if the scene may change with time for a fixed camera: by animated numbers, disk
//! clouds or moving objects. Captions and overlays do not belong to the scene.
bool changes_by_itself(const Show& show);

//! Returns the spacetime at a show time.
Spacetime spacetime_at(const Show& show, double time_s);

//! Returns the minimum and maximum value of an animation.
NumberLimits range_of(const Animation& animation);

//! Return the show with each animated number at its minimum, or at its maximum. If the show
//! requires a feature at any time, at least one of these two shows requires it.
Show show_at_least(Show show);
Show show_at_most(Show show);

}  // namespace ergodome
