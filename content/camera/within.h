#pragma once

#include <optional>

#include "content/show/show.h"

namespace ergodome {

//! Minimum ratio, larger to smaller, between the horizon's radius and the radius at which the clock
//! of a fall stops, whether outside or inside the horizon.
inline constexpr double nearest_rest = 1.001;

//! Returns the minimum radius at which the clock of a fall can stop [M].
double deepest_rest(Spacetime spacetime);

//! Returns true if falls can stop inside the horizon; false if the spin is 1 or -1, or almost.
bool has_inside(Spacetime spacetime);

//! Returns, in English and German, which feature of a show cannot be shown from inside the horizon.
//! Returns nothing if all can.
std::optional<LocalText> hidden_within(const Show& show);

//! Returns, in English and German, why visitors of a show may not fall through the horizon; nothing
//! if they may. The stereo model "flat" does not prevent it, as the player then uses another model.
std::optional<LocalText> kept_outside(const Show& show);

}  // namespace ergodome
