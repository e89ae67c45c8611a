#pragma once

#include <string>

#include "calibration/dome_setup.h"
#include "calibration/mpcdi.h"

namespace ergodome {

//! A dome setup whose projectors are the regions of a calibration, side by side on the desktop. Warps and masks stay in `file`,
//! which the setup names; lenses and places of profiles 3d and sl come into the setup, where they can be adjusted. MPCDI does not
//! tell a dome's radius.
DomeSetup setup_from_mpcdi(const Mpcdi& mpcdi, const std::string& file, double radius_m);

//! A calibration of a setup's projectors, with their files read. Where all have flat warps it is of profile 2d: a warp for each
//! pixel, the alpha mask from intensities and blend mask, the beta mask from black level and lift. Where none has a file of a
//! warp it is of profile sl, with the flat lenses and places alone. Throws Error, naming the projector, for anything else, which
//! MPCDI has no one profile for.
Mpcdi mpcdi_from_setup(const DomeSetup& setup, const std::string& date);

}  // namespace ergodome
