#pragma once

#include <optional>

#include "content/show/show.h"

namespace ergodome {

//! Where time may come to rest, relative to the horizon.
inline constexpr double nearest_rest = 1.001;

//! The deepest place [M] that falls lead to.
double deepest_rest(double spin);

//! Whether there is room within the horizon for a fall to come to rest: not where the spin is 1 or -1, or all but that.
bool has_inside(double spin);

//! What a show has that its own fall through the horizon cannot show, in English and German; nothing where all of it can be seen.
std::optional<LocalText> hidden_within(const Show& show);

//! Why a visitor of a show may not fall through the horizon, in English and German; nothing where he may. Eyes of the model flat keep nobody
//! outside: the player draws others in their place.
std::optional<LocalText> kept_outside(const Show& show);

}  // namespace ergodome
