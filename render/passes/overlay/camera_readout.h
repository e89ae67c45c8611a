#pragma once

#include <string>

#include "content/show/show.h"

namespace ergodome {

//! Returns the text of a readout in English ("en") and German ("de"): the hole's spin, and distance
//! and latitude of a camera at radius r [M] and polar angle theta [rad].
LocalText readout_text(Spacetime spacetime, double r, double theta);

//! Returns a readout as a caption. Caption::presence is not used.
Caption readout_caption(const ReadoutSettings& readout, Spacetime spacetime, double r, double theta);

}  // namespace ergodome
