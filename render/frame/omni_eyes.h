#pragma once

#include <vector>

#include "content/camera/camera_path.h"
#include "render/frame/flat_eyes.h"
#include "render/lens/omni_chooser.h"

namespace ergodome {

//! Renders both omnidirectional stereo (ODS) eyes, in which each direction of the view has its own
//! camera. Caches their lenses for the next picture.
class OmniEyes {
 public:
  explicit OmniEyes(Backend backend) : backend_(backend), lenses_(backend) {}

  //! `head`: the head's picture at a pose. `shutter`: the head's poses while the shutter is open,
  //! if stars leave trails. Reduces the baseline if it does not fit. Throws Error if no baseline
  //! fits at the pose.
  StereoPictures render(EyeRenderer& renderer, const CameraPose& pose, const EyePicture& head, const SkyCube& sky,
                        const std::vector<CameraPose>& shutter);

 private:
  Backend backend_;
  OmniChooser lenses_;
};

}  // namespace ergodome
