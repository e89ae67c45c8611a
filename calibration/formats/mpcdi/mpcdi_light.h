#pragma once

#include "calibration/formats/mpcdi/mpcdi.h"
#include "calibration/projectors/projector_picture.h"

namespace ergodome {

//! Whether a projector's gain changes its light.
bool has_gain(const Vector3<double>& gain);

//! The lift of a black level as a betaMap, times the gain; nothing where there is none.
std::optional<MpcdiMask> beta_of(const BlendMap& black_level, const Vector3<double>& lift, const Vector3<double>& gain);

//! Gives a region a projector's blend, black level, gain and gamma. MPCDI knows light L (1 - b) a + b (VESA MPCDI 2.0, 2.4) and no gain g, so that alpha and
//! beta get it: b' = g b, a' = g a (1 - b) / (1 - g b). `intensity` is a grey map of factors of the light, in the size that the alphaMap gets. Factors above 1
//! become 1, as of gains above 1 where no mask dims.
void put_light(const ProjectorPicture& picture, const BlendMap& intensity, MpcdiRegion& region);

}  // namespace ergodome
