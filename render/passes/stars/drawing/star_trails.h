#pragma once

#include "render/passes/stars/search/star_finder.h"

namespace ergodome {

//! Eyes at equal time steps while the shutter is open. Their number is odd; the one in the middle
//! is the picture's eye.
struct Shutter {
  std::vector<StarEye> eyes;
};

//! Motion of star images while a shutter is open.
struct StarTrails {
  //! The trail of one image. It is visible to the shutter's eyes with indices from `first` to
  //! `last`: next to a caustic or the shadow, images appear and disappear.
  struct Way {
    int first;
    int last;
    Vector3<float> illuminance;
  };

  int positions = 0;  //!< number of eyes of the shutter
  std::vector<Way> ways;
  //! Direction of each image in the frame of each eye: unit vectors, `positions` per image.
  std::vector<Vector3<float>> directions;
};

//! Traces the motion of each image with rays, from the middle of the exposure to its beginning and
//! end. `pixel`: angle of a pixel [rad].
StarTrails star_trails(const std::vector<StarImage>& images, const StarField& field, const Shutter& shutter,
                       double pixel);

}  // namespace ergodome
