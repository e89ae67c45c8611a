#include "render/stars/star_twins.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ergodome {

namespace {

//! Images of one star nearer to each other than this, and not turned over, are one.
constexpr double same_image_px = 0.1;
//! The longest arc that an image is taken for [rad].
constexpr double longest_arc = 1.5;

//! How far an image stretches because its star is a disk: next to a caustic it is an arc, whose middle needs no better place than that.
double arc_of(const StarCandidate& c) {
  return std::min(c.radius / std::sqrt(std::max(singular_values(c).smaller_square, 1e-30)), longest_arc);
}

//! Candidates by star, for each in their order.
std::vector<std::size_t> by_star(const std::vector<StarImage>& found, std::size_t stars) {
  // Sorting by counting: where each star's images begin, those that are none before all.
  std::vector<std::size_t> place(stars + 2, 0);
  for (const StarImage& image : found) {
    place[static_cast<std::size_t>(image.star) + 2U] += 1;
  }
  place[1] = 0;
  std::partial_sum(place.begin(), place.end(), place.begin());
  std::vector<std::size_t> order(place.back());
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i].star >= 0) {
      order[place[static_cast<std::size_t>(found[i].star) + 1U]++] = i;
    }
  }
  return order;
}

//! An image with what tells it from another.
struct SortedImage {
  const StarImage* image;
  double arc;   //!< [rad]
  bool capped;  //!< by its star's disk: which side it turns to means nothing
};

//! Whether two images of a star are one that was found twice.
bool are_one(const SortedImage& a, const SortedImage& b, double pixel) {
  const Vector3<float> apart = a.image->direction - b.image->direction;
  const auto square = static_cast<double>(dot(apart, apart));
  const float ratio = a.image->magnification / b.image->magnification;
  const bool one_side = ratio > 0.0F;
  if (square < same_image_px * same_image_px * pixel * pixel && one_side) {
    return true;
  }
  // Rings of different order lie side by side, arcs of one ring are as bright as each other.
  const double arc = std::max(a.arc, b.arc);
  return square < arc * arc && std::abs(std::log(std::abs(ratio))) < 0.7F && (one_side || (a.capped && b.capped));
}

}  // namespace

double capped_solid_angle(const StarCandidate& c) {
  return std::max(std::abs(c.solid_angle), 0.5 * c.radius * std::sqrt(singular_values(c).larger_square));
}

std::vector<StarImage> without_twins(const std::vector<StarImage>& found, const std::vector<StarCandidate>& candidates,
                                     std::size_t stars, double pixel) {
  std::vector<StarImage> images;
  images.reserve(found.size());
  std::vector<SortedImage> of_star;
  for (const std::size_t i : by_star(found, stars)) {
    if (!of_star.empty() && of_star.front().image->star != found[i].star) {
      of_star.clear();
    }
    const StarCandidate& c = candidates[i];
    const SortedImage sorted = {&found[i], arc_of(c), capped_solid_angle(c) > std::abs(c.solid_angle)};
    if (std::ranges::none_of(of_star, [&](const SortedImage& other) { return are_one(sorted, other, pixel); })) {
      of_star.push_back(sorted);
      images.push_back(found[i]);
    }
  }
  return images;
}

}  // namespace ergodome
