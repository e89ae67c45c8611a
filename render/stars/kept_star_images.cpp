#include "render/stars/kept_star_images.h"

#include <algorithm>
#include <utility>

namespace ergodome {

namespace {

//! How far beyond the view of a camera that turns images are sought [rad]: by solid angle a dome has a fifth more of them then, a window of 60 degrees seven tenths, and a
//! camera that turns by two degrees a picture seeks them for every seventh.
constexpr double turning_margin = 0.25;

//! Whether images that were found are those that are asked for, but for the view.
bool serve(const StarSettings& found, const StarSettings& asked) {
  return (asked.about || !found.about) && serves_pixel(found.pixel, asked.pixel, asked.about) &&
         found.grid_px == asked.grid_px && found.least_cell_px == asked.least_cell_px &&
         found.faintest == asked.faintest && found.redshift == asked.redshift &&
         found.magnification == asked.magnification;
}

}  // namespace

const std::vector<StarImage>& KeptStarImages::images(const StarEye& eye, const StarSettings& settings,
                                                     const Seek& seek) {
  const auto found = std::ranges::find_if(
      places_, [&](const Place& at) { return sees_alike(at.eye, eye) && serve(at.settings, settings); });
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
  std::vector<StarImage> images = seek(asked);
  places_.insert(places_.begin(), Place{eye, asked, std::move(images)});
  return places_.front().images;
}

}  // namespace ergodome
