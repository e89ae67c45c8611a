#include "render/stars/star_twins.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "kernels/launch/parallel_for.h"

namespace ergodome {

namespace {

//! Images of one star nearer to each other than this, and not turned over, are one.
constexpr double same_image_px = 0.1;
//! The longest arc that an image is taken for [rad].
constexpr double longest_arc = 1.5;

//! Numbers of images by star, for each in their order.
std::vector<std::uint32_t> by_star(const std::vector<FoundImage>& found, std::size_t stars) {
  // Sorting by counting: where each star's images begin, those that are none before all.
  std::vector<std::uint32_t> place(stars + 2, 0);
  for (const FoundImage& each : found) {
    place[static_cast<std::size_t>(each.image.star) + 2U] += 1;
  }
  place[1] = 0;
  std::partial_sum(place.begin(), place.end(), place.begin());
  std::vector<std::uint32_t> order(place.back());
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i].image.star >= 0) {
      order[place[static_cast<std::size_t>(found[i].image.star) + 1U]++] = static_cast<std::uint32_t>(i);
    }
  }
  return order;
}

//! Whether two images of a star are one that was found twice.
bool are_one(const FoundImage& a, const FoundImage& b, double pixel) {
  const Vector3<float> apart = a.image.direction - b.image.direction;
  const auto square = static_cast<double>(dot(apart, apart));
  const float ratio = a.image.magnification / b.image.magnification;
  const bool one_side = ratio > 0.0F;
  if (square < same_image_px * same_image_px * pixel * pixel && one_side) {
    return true;
  }
  // Rings of different order lie side by side, arcs of one ring are as bright as each other.
  const auto arc = static_cast<double>(std::max(a.arc, b.arc));
  return square < arc * arc && std::abs(std::log(std::abs(ratio))) < 0.7F && (one_side || (a.capped && b.capped));
}

}  // namespace

double capped_solid_angle(const StarCandidate& c) {
  return std::max(std::abs(c.solid_angle), 0.5 * c.radius * std::sqrt(singular_values(c).larger_square));
}

FoundImage found_image(const StarImage& image, const StarCandidate& candidate) {
  // Next to a caustic an image is an arc, whose middle needs no better place than that.
  const double smaller = std::max(singular_values(candidate).smaller_square, 1e-30);
  const double arc = std::min(candidate.radius / std::sqrt(smaller), longest_arc);
  return {image, static_cast<float>(arc), capped_solid_angle(candidate) > std::abs(candidate.solid_angle)};
}

std::vector<StarImage> without_twins(const std::vector<FoundImage>& found, std::size_t stars, double pixel) {
  const std::vector<std::uint32_t> order = by_star(found, stars);
  const auto star_at = [&](std::size_t i) { return found[order[i]].image.star; };
  constexpr std::size_t chunk = 2048;
  std::vector<std::vector<StarImage>> parts((order.size() + chunk - 1) / chunk);
  parallel_for(static_cast<int>(parts.size()), 1, [&](int begin, int end) {
    for (auto part = static_cast<std::size_t>(begin); part < static_cast<std::size_t>(end); ++part) {
      // A star belongs to the part that its first image lies in.
      std::size_t i = part * chunk;
      while (i > 0 && i < order.size() && star_at(i) == star_at(i - 1)) {
        ++i;
      }
      std::size_t first = i;
      std::vector<const FoundImage*> of_star;
      for (; i < order.size() && (i < (part + 1) * chunk || star_at(i) == star_at(i - 1)); ++i) {
        if (star_at(i) != star_at(first)) {
          first = i;
          of_star.clear();
        }
        const FoundImage& here = found[order[i]];
        if (std::ranges::none_of(of_star, [&](const FoundImage* other) { return are_one(here, *other, pixel); })) {
          of_star.push_back(&here);
          parts[part].push_back(here.image);
        }
      }
    }
  });
  std::vector<StarImage> images;
  images.reserve(order.size());
  for (const std::vector<StarImage>& part : parts) {
    images.insert(images.end(), part.begin(), part.end());
  }
  return images;
}

}  // namespace ergodome
