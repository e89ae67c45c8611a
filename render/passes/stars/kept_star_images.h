#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "render/passes/stars/search/star_finder.h"

namespace ergodome {

//! Returns whether images found with one set of settings can be reused for another, ignoring the
//! view.
bool serves(const StarSettings& found, const StarSettings& asked);

//! Angle by which the search extends beyond the view of a turning camera [rad]. It increases the
//! solid angle of a dome by a fifth, and that of a 60-degree window by seven tenths. A camera that
//! turns by two degrees per frame then needs a search only in every seventh frame.
inline constexpr double turning_margin = 0.25;

//! Caches the star images of the eyes of the last frames. Images are stored in the observer's
//! frame, so they stay valid if the camera only rotates, or if only other things move. `Images`:
//! std::vector<StarImage> or PlacedImages.
template <class Images>
class KeptStarImages {
 public:
  //! Returns the star images in `settings.view`, and possibly more. If none are cached, it calls
  //! `seek(settings)`. For a camera that has turned, it first enlarges the view by
  //! `turning_margin`, so that the cache can be used after further turns. The reference is valid
  //! until the next call.
  template <class Seek>
  const Images& images(const StarEye& eye, const StarSettings& settings, const Seek& seek) {
    const auto found = std::ranges::find_if(
        places_, [&](const Place& at) { return sees_alike(at.eye, eye) && serves(at.settings, settings); });
    if (found != places_.end() && holds(found->settings.view, settings.view)) {
      std::rotate(places_.begin(), found, found + 1);
      return places_.front().images;
    }
    StarSettings asked = settings;
    if (found != places_.end()) {
      asked.view = widened(asked.view, turning_margin);
      places_.erase(found);
    } else if (places_.size() == most_eyes) {
      places_.pop_back();
    }
    Images images = seek(asked);
    places_.insert(places_.begin(), Place{eye, asked, std::move(images)});
    return places_.front().images;
  }

 private:
  struct Place {
    StarEye eye;
    StarSettings settings;
    Images images;
  };

  std::vector<Place> places_;  //!< most recently used first
};

}  // namespace ergodome
