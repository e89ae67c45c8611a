#pragma once

#include <cstddef>
#include <memory>

#include "render/lens/omni_lens.h"

namespace ergodome {

//! An eye whose star images are searched for: a single camera, or an omnidirectional stereo (ODS)
//! eye, which has a separate camera for each viewing direction.
struct StarEye {
  StarEye(const EyeCamera& single) : camera(single) {}  // NOLINT(google-explicit-constructor): a camera is an eye
  explicit StarEye(std::shared_ptr<const OmniEye> eye) : camera(eye->head), omni(std::move(eye)) {}

  EyeCamera camera;                     //!< frame of the images; for an ODS eye, the head with the view's axes
  std::shared_ptr<const OmniEye> omni;  //!< null for a single camera
};

//! Maximum number of eyes per picture.
inline constexpr std::size_t max_eyes = 2;

//! Returns whether one lens grid can be used for both eyes. A grid stays valid if a camera rotates
//! or moves around the spin axis.
bool served_alike(const StarEye& first, const StarEye& second);

//! Returns whether two eyes have the same star images in the observer's frame: same spacetime,
//! position and velocity. Their viewing directions may differ.
bool sees_alike(const StarEye& first, const StarEye& second);

}  // namespace ergodome
