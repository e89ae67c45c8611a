#pragma once

#include <string>

#include "calibration/dome/dome_setup.h"
#include "calibration/formats/mpcdi/mpcdi.h"

namespace ergodome {

//! What is to be said after the name of a calibration that was made of a setup: that it does not tell how the dome leans, by which test
//! patterns are level, and the remedy. Empty where the dome does not lean.
std::string tilt_note(const DomeSetup& setup, const Mpcdi& mpcdi);

}  // namespace ergodome
