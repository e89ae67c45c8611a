#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "render/passes/stars/search/star_finder.h"

namespace ergodome {

//! Returns whether images found with one set of settings can be reused for another, ignoring the
//! view.
bool serves(const StarSettings& found, const StarSettings& asked);

//! Angle by which the search extends beyond the view of a turning camera [rad]. This margin
//! increases the solid angle of a dome by a fifth, and that of a 60-degree window by seven tenths.
//! A camera that turns by two degrees per frame then needs a search only in every seventh frame.
inline constexpr double rotation_margin = 0.25;

//! Caches the star images of the eyes of the last frames. Images are stored in the observer's
//! frame, so they stay valid if the camera only rotates, or if only other things move. `Images`:
//! std::vector<StarImage> or PlacedImages.
template <class Images>
class StarImageCache {
 public:
  //! Returns the star images in `settings.view`, and possibly more. If no cached images cover the
  //! view, calls `seek(settings)`. For a camera that has turned, the view is first enlarged by
  //! `rotation_margin`, so that the cache can be used after further turns. The reference is valid
  //! until the next call.
  template <class Seek>
  const Images& images(const StarEye& eye, const StarSettings& settings, const Seek& seek) {
    const auto found = std::ranges::find_if(
        entries_, [&](const Entry& at) { return sees_alike(at.eye, eye) && serves(at.settings, settings); });
    if (found != entries_.end() && holds(found->settings.view, settings.view)) {
      std::rotate(entries_.begin(), found, found + 1);
      return entries_.front().images;
    }
    StarSettings asked = settings;
    if (found != entries_.end()) {
      asked.view = widened(asked.view, rotation_margin);
      entries_.erase(found);
    } else if (entries_.size() == max_eyes) {
      entries_.pop_back();
    }
    Images images = seek(asked);
    entries_.insert(entries_.begin(), Entry{eye, asked, std::move(images)});
    return entries_.front().images;
  }

 private:
  struct Entry {
    StarEye eye;
    StarSettings settings;
    Images images;
  };

  std::vector<Entry> entries_;  //!< most recently used first
};

}  // namespace ergodome
