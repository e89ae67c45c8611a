#pragma once

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

}  // namespace ergodome
