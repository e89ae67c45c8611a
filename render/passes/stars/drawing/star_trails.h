#pragma once

#include "render/passes/stars/search/star_finder.h"

namespace ergodome {

//! The eye at equal steps of the time that a shutter is open: an odd number of them, the picture's own eye in the middle.
struct Shutter {
  std::vector<StarEye> eyes;
};

//! Images on their way while a shutter is open.
struct StarTrails {
  //! Where an image is, in the frames of the shutter's eyes [first, last] that see it: next to a caustic or the shadow, images come and go.
  struct Way {
    int first;
    int last;
    Vector3<float> illuminance;
  };

  int places = 0;  //!< eyes of the shutter
  std::vector<Way> ways;
  std::vector<Vector3<float>> directions;  //!< unit vectors, `places` for each image
};

//! Follows images from the middle of a shutter's time to both ends, by rays: each stays the image that it is. `pixel`: angle of a pixel
//! [rad].
StarTrails star_trails(const std::vector<StarImage>& images, const StarField& field, const Shutter& shutter,
                       double pixel);

}  // namespace ergodome
