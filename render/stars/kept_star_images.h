#pragma once

#include <functional>
#include <vector>

#include "render/stars/star_finder.h"

namespace ergodome {

//! Images of stars of the last pictures' eyes. They lie in the observer's frame: a camera that turns on its spot, or stands while other things move, sees
//! them again.
class KeptStarImages {
 public:
  using Seek = std::function<std::vector<StarImage>(const StarSettings&)>;

  //! The images in `settings.view`, and maybe more; `seek` finds those that a view shows where none are kept. Once a camera turns they are sought some way
  //! beyond its view, so that it can turn on. Valid until the next call.
  const std::vector<StarImage>& images(const StarEye& eye, const StarSettings& settings, const Seek& seek);

 private:
  struct Place {
    StarEye eye;
    StarSettings settings;
    std::vector<StarImage> images;
  };

  std::vector<Place> places_;  //!< the last one first
};

}  // namespace ergodome
