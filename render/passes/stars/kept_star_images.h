#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "render/passes/stars/search/star_finder.h"

namespace ergodome {

//! Whether images that were found are those that are asked for, but for the view.
bool serves(const StarSettings& found, const StarSettings& asked);

//! How far beyond the view of a camera that turns images are sought [rad]: by solid angle a dome has a fifth more of them then, a window of 60 degrees seven tenths, and a
//! camera that turns by two degrees a picture seeks them for every seventh.
inline constexpr double turning_margin = 0.25;

//! Images of stars of the last pictures' eyes. They lie in the observer's frame: a camera that turns on its spot, or stands while other things move, sees
//! them again. `Images`: std::vector<StarImage>, or PlacedImages.
template <class Images>
class KeptStarImages {
 public:
  //! The images in `settings.view`, and maybe more; `seek(settings)` finds those that a view shows where none are kept. Once a camera turns they are sought
  //! some way beyond its view, so that it can turn on. Valid until the next call.
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

  std::vector<Place> places_;  //!< the last one first
};

}  // namespace ergodome
