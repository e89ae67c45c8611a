#pragma once

#include <string>

#include "content/show/show.h"

namespace ergodome {

//! Returns the words of a readout in English ("en") and German ("de"): spin, distance and latitude of a camera at r [M] and
//! polar angle theta [rad].
LocalText readout_text(Spacetime spacetime, double r, double theta);

//! Returns a readout as a caption. Its presence is not used.
Caption readout_caption(const ReadoutSettings& readout, Spacetime spacetime, double r, double theta);

}  // namespace ergodome
