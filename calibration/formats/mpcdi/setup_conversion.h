#pragma once

#include <functional>
#include <string>
#include <vector>

#include "calibration/dome/dome_setup.h"
#include "calibration/formats/mpcdi/mpcdi.h"
#include "calibration/projectors/projector_picture.h"

namespace ergodome {

//! A dome setup whose projectors are the regions of a calibration, side by side on the desktop. Warps and masks stay in `file`,
//! which the setup names; lenses and places of profiles 3d and sl come into the setup, where they can be adjusted. MPCDI does not
//! tell a dome's radius.
DomeSetup setup_from_mpcdi(const Mpcdi& mpcdi, const std::string& file, double radius_m);

//! A calibration of a setup's projectors, with their files read. Where all have a flat lens and a place, and neither a warp nor a mirror,
//! it is of profile sl, with those in the dome's own axes, which tilt and rotation are then in, and the masks. Every other setup becomes one of profile 2d, which has what each projector shows of the
//! domemaster, as projector_pictures() tells it: a warp for each pixel, with the setup's rotation in it, which MPCDI does not tell; the
//! alpha mask from intensities and blend mask; the beta mask from black level and lift. Gains are in both masks (put_light()). Throws Error for what projector_pictures() refuses.
Mpcdi mpcdi_from_setup(const DomeSetup& setup, const std::string& date);

//! Returns a calibration of profile 2d with these pictures, whose warps have as many samples as they need
//! (thinned_map()). Calls `progress` with the number of finished regions.
Mpcdi mpcdi_from_pictures(const std::vector<ProjectorPicture>& pictures, const std::string& date,
                          const std::function<void(long)>& progress = {});

}  // namespace ergodome
