#pragma once

#include "render/passes/stars/search/star_finder.h"

namespace ergodome {

//! Eyes at equal time steps while the shutter is open. Their number is odd; the middle one is the
//! picture's eye.
struct Shutter {
  std::vector<StarEye> eyes;
};

//! Motion of star images while a shutter is open.
struct StarTrails {
  //! One image, visible to the shutter's eyes [first, last]: next to a caustic or the shadow,
  //! images appear and disappear. Positions are in the frames of these eyes.
  struct Way {
    int first;
    int last;
    Vector3<float> illuminance;
  };

  int places = 0;  //!< number of eyes of the shutter
  std::vector<Way> ways;
  std::vector<Vector3<float>> directions;  //!< unit vectors, `places` per image
};

//! Follows images by ray tracing from the middle of the exposure to both ends, keeping the identity
//! of each. `pixel`: angle of a pixel [rad].
StarTrails star_trails(const std::vector<StarImage>& images, const StarField& field, const Shutter& shutter,
                       double pixel);

}  // namespace ergodome
