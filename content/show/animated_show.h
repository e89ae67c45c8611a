#pragma once

#include "content/show/animatable_number.h"

namespace ergodome {

//! The value of an animated number at a show time. It keeps the first key's before it and the last one's after it.
//!
//! On Ease::smooth ways it is C² and does not pass its keys (content/key_curve.h); other ways are as Ease says. Times are taken from the
//! key before: late in a show they are as exact as doubles tell them.
double value_at(const Animation& animation, double time_s);

//! Puts every animated number's value at a show time into the show, and tells what has changed. A show without animations stays
//! untouched; nothing is copied.
NumberChange animate(Show& show, double time_s);

//! The same in a copy.
Show show_at(Show show, double time_s);

//! The animation of a number, or nullptr.
const Animation* find_animation(const Show& show, std::string_view path);

//! Whether the scene may differ from one time of the show to another, wherever the camera is: by numbers that change, clouds of a disk, objects that move. Captions
//! and overlays are not the scene's.
bool changes_by_itself(const Show& show);

//! The hole's spin at a show time.
double spin_at(const Show& show, double time_s);

//! Least and greatest value that an animated number has.
NumberLimits range_of(const Animation& animation);

//! The show with each animated number at the least or at the greatest value that it ever has: what it may call for at some time
//! is what one of the two does.
Show show_at_least(Show show);
Show show_at_most(Show show);

}  // namespace ergodome
