#pragma once

#include <string>

#include "calibration/dome/dome_setup.h"
#include "calibration/formats/mpcdi/mpcdi.h"

namespace ergodome {

//! Returns a note for a calibration converted from a setup, if the dome is tilted: the file does
//! not store the tilt, which level test patterns need, and the remedy. The note follows the file's
//! name. Empty without a tilt.
std::string tilt_note(const DomeSetup& setup, const Mpcdi& mpcdi);

}  // namespace ergodome
