#pragma once

#include "render/lens/omni_lens.h"

namespace ergodome {

//! Describes where the rays of a frame start: at a camera or, if `omni` is set, at an eye of
//! omnidirectional stereo (ODS), whose position turns with the viewing direction.
struct PictureView {
  const EyeCamera& eye;
  const OmniEye* omni;
  const Projection& projection;
  double tolerance_px;
  double time_s;  //!< show time, for objects that move

  //! Returns the camera, or the head of an ODS eye (whose frame is the view's axes).
  [[nodiscard]] const EyeCamera& camera() const { return omni != nullptr ? omni->head : eye; }
};

}  // namespace ergodome
