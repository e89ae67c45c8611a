#pragma once

#include <functional>
#include <string>
#include <vector>

#include "calibration/dome/dome_setup.h"
#include "calibration/formats/mpcdi/mpcdi.h"
#include "calibration/projectors/projector_picture.h"

namespace ergodome {

//! Returns true if a projector's gain changes its light.
bool has_gain(const Vector3<double>& gain);

//! Returns the lift of a black level times the gain as a betaMap; nothing without a lift.
std::optional<MpcdiMask> beta_of(const BlendMap& black_level, const Vector3<double>& lift, const Vector3<double>& gain);

//! Sets the masks and gammas of a region from a projector's blend, black level, gain and gamma.
//! MPCDI light is L (1 - b) a + b (VESA MPCDI 2.0, 2.4) and has no gain g, so alpha and beta
//! include it: b' = g b, a' = g a (1 - b) / (1 - g b). `intensity` is a gray map of light factors
//! in the size of the alphaMap. Factors are clamped to 1, for example for gains above 1 where no
//! mask dims.
void put_light(const ProjectorPicture& picture, const BlendMap& intensity, MpcdiRegion& region);

//! Returns a dome setup whose projectors are the regions of a calibration, side by side on the
//! desktop. The setup names `file` for warps and masks; it contains lenses and poses of profiles 3d
//! and sl, so that they can be adjusted. The radius is a parameter because MPCDI does not contain
//! it.
DomeSetup setup_from_mpcdi(const Mpcdi& mpcdi, const std::string& file, double radius_m);

//! Reads the files of a setup and returns its calibration.
//!
//! If all projectors have a flat lens and a pose, and neither a warp nor a mirror, it has profile
//! sl: the poses in the dome's own axes, with tilt and rotation applied, and the masks.
//!
//! Otherwise it has profile 2d, with what each projector shows of the domemaster
//! (projector_pictures()): a warp with a sample per pixel, which includes the setup's rotation; an
//! alpha mask from intensities and blend mask; a beta mask from black level and lift. Both masks
//! include gains (put_light()). Throws Error as projector_pictures() does.
Mpcdi mpcdi_from_setup(const DomeSetup& setup, const std::string& date);

//! Returns a calibration of profile 2d for these projectors. Their warps have as many samples as
//! necessary (thinned_map()). Calls `progress` with the number of finished regions.
Mpcdi mpcdi_from_pictures(const std::vector<ProjectorPicture>& pictures, const std::string& date,
                          const std::function<void(long)>& progress = {});

//! Returns a note about the calibration converted from the setup of a tilted dome: it includes the
//! tilt in its data but does not state the tilt as a number, which level test patterns require. The
//! note also states what to do. The note is written so that it can follow the file's name. Empty
//! without a tilt.
std::string tilt_note(const DomeSetup& setup, const Mpcdi& mpcdi);

}  // namespace ergodome
