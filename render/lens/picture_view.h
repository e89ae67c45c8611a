#pragma once

#include "render/lens/omni_lens.h"

namespace ergodome {

//! How a picture's rays begin: at a camera, or where `turning` is given, at an eye that turns with the direction one looks at.
struct PictureView {
  const EyeCamera& eye;
  const OmniEye* turning;
  const Projection& projection;
  double tolerance_px;
  double time_s;  //!< of the show, for what moves in it

  //! The camera itself, or that of the turning eye's head with the view's axes for its frame.
  [[nodiscard]] const EyeCamera& camera() const { return turning != nullptr ? turning->head : eye; }
};

}  // namespace ergodome
