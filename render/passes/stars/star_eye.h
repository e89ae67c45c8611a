#pragma once

#include <cstddef>
#include <memory>

#include "render/lens/omni_lens.h"

namespace ergodome {

//! Eye for which stars are sought: a single camera, or an omnidirectional stereo (ODS) eye, which
//! has a separate camera for each viewing direction.
struct StarEye {
  StarEye(const EyeCamera& single) : camera(single) {}  // NOLINT(google-explicit-constructor): a camera is an eye
  explicit StarEye(std::shared_ptr<const OmniEye> turning) : camera(turning->head), omni(std::move(turning)) {}

  EyeCamera camera;                     //!< frame of the images; for an ODS eye, the head with the view's axes
  std::shared_ptr<const OmniEye> omni;  //!< null for a single camera
};

//! Maximum number of eyes per picture.
inline constexpr std::size_t most_eyes = 2;

//! Returns whether one lens grid serves both eyes. Rotating a camera, or moving it around the spin
//! axis, does not invalidate its grid.
bool served_alike(const StarEye& first, const StarEye& second);

//! Returns whether two eyes have identical star images in the observer's frame. Their viewing
//! directions may differ.
bool sees_alike(const StarEye& first, const StarEye& second);

}  // namespace ergodome
