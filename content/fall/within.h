#pragma once

#include <optional>

#include "content/show.h"

namespace ergodome {

//! Where time may come to rest, relative to the horizon.
inline constexpr double nearest_rest = 1.001;

//! The deepest place [M] that falls lead to.
double deepest_rest(double spin);

//! Whether there is room within the horizon for a fall to come to rest: not where the spin is 1 or -1, or all but that.
bool has_inside(double spin);

//! What a show has that cannot be seen from within the horizon, in English and German; nothing where all of it can. The one place that says so.
std::optional<LocalText> hidden_within(const Show& show);

//! Why a visitor of a show may not fall through the horizon, in English and German; nothing where he may.
std::optional<LocalText> kept_outside(const Show& show);

}  // namespace ergodome
