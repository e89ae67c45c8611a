#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/passes/stars/search/star_finder.h"

// What becomes of star images from one picture to the next.
namespace ergodome::test {

//! Each image continues as the nearest image of the same star and parity in the next step. Returns
//! the images of `before` that do not continue in `now`.
inline std::vector<StarImage> ended(const std::vector<StarImage>& before, const std::vector<StarImage>& now) {
  struct Step {
    float square;
    std::size_t from;
    std::size_t to;
  };
  std::vector<Step> steps;
  for (std::size_t i = 0; i < before.size(); ++i) {
    for (std::size_t k = 0; k < now.size(); ++k) {
      const Vector3<float> way = now[k].direction - before[i].direction;
      const bool same_side = (now[k].magnification < 0.0F) == (before[i].magnification < 0.0F);
      if (now[k].star == before[i].star && same_side && dot(way, way) < 0.3F * 0.3F) {
        steps.push_back({dot(way, way), i, k});
      }
    }
  }
  std::ranges::sort(steps, {}, &Step::square);
  std::vector<bool> left(before.size());
  std::vector<bool> reached(now.size());
  for (const Step& step : steps) {
    if (!left[step.from] && !reached[step.to]) {
      left[step.from] = true;
      reached[step.to] = true;
    }
  }
  std::vector<StarImage> rest;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (!left[i]) {
      rest.push_back(before[i]);
    }
  }
  return rest;
}

//! Returns whether two images are about to merge. This happens only if a star crosses a caustic,
//! always to two images of the same star with opposite parity.
inline bool may_merge(const StarImage& image, const StarImage& other) {
  const Vector3<float> apart = other.direction - image.direction;
  return other.star == image.star && dot(apart, apart) < 0.3F * 0.3F &&
         (other.magnification < 0.0F) != (image.magnification < 0.0F);
}

//! Returns whether an image is so bright, and so far from a caustic, that it must exist in the next
//! picture unless it merges with another.
inline bool must_go_on(const StarImage& image, const StarSettings& settings) {
  return image.illuminance.y > 3.0F * settings.faintest && std::abs(image.magnification) < 3.0F;
}

//! Returns the number of images that end although they must go on and merge with no other.
inline std::size_t images_lost(const std::vector<StarImage>& before, const std::vector<StarImage>& now,
                               const StarSettings& settings) {
  const std::vector<StarImage> gone = ended(before, now);
  return static_cast<std::size_t>(std::ranges::count_if(gone, [&](const StarImage& image) {
    return must_go_on(image, settings) &&
           std::ranges::none_of(gone, [&](const StarImage& other) { return may_merge(image, other); });
  }));
}

}  // namespace ergodome::test
