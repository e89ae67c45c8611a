#include "render/passes/stars/search/star_twins.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>

#include "kernels/launch/parallel_for.h"
#include "kernels/stars/search/same_image.h"

namespace ergodome {

namespace {

//! Returns the image indices sorted by star, stable within each star.
std::vector<std::uint32_t> by_star(const std::vector<SeenImage>& found, std::size_t stars) {
  // Counting sort: start of each star's images, with unused entries before all others.
  std::vector<std::uint32_t> place(stars + 2, 0);
  for (const SeenImage& each : found) {
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

void sort_by_place(const std::vector<SeenImage>& found, std::span<std::uint32_t> of_star) {
  std::ranges::sort(of_star,
                    [&](std::uint32_t a, std::uint32_t b) { return comes_before(found[a].image, found[b].image); });
}

//! Appends each image of a star once.
void add_without_twins(const std::vector<SeenImage>& found, std::span<const std::uint32_t> of_star, double pixel,
                       std::vector<StarImage>& images) {
  std::vector<const SeenImage*> taken;
  for (const std::uint32_t number : of_star) {
    const SeenImage& here = found[number];
    if (std::ranges::none_of(taken, [&](const SeenImage* other) { return are_one_image(here, *other, pixel); })) {
      taken.push_back(&here);
      images.push_back(here.image);
    }
  }
}

}  // namespace

double capped_solid_angle(const StarCandidate& c) {
  return std::max(std::abs(c.solid_angle), 0.5 * c.radius * std::sqrt(singular_values(c).larger_square));
}

SeenImage seen_image(const StarImage& image, const StarCandidate& candidate) {
  // Next to a caustic an image is an arc; the position of its middle needs no higher accuracy than
  // the arc's length.
  const double smaller = std::max(singular_values(candidate).smaller_square, 1e-30);
  const double arc = std::min(candidate.radius / std::sqrt(smaller), static_cast<double>(longest_arc));
  return {image, static_cast<float>(arc), capped_solid_angle(candidate) > std::abs(candidate.solid_angle)};
}

std::vector<StarImage> without_twins(const std::vector<SeenImage>& found, std::size_t stars, double pixel,
                                     FindingOrder order) {
  const std::vector<std::uint32_t> numbers = by_star(found, stars);
  const auto star_at = [&](std::size_t i) { return found[numbers[i]].image.star; };
  constexpr std::size_t chunk = 2048;
  std::vector<std::vector<StarImage>> parts((numbers.size() + chunk - 1) / chunk);
  parallel_for(static_cast<int>(parts.size()), 1, [&](int begin, int end) {
    std::vector<std::uint32_t> of_star;
    for (auto part = static_cast<std::size_t>(begin); part < static_cast<std::size_t>(end); ++part) {
      // A star belongs to the part that contains its first image.
      const std::size_t next_part = std::min((part + 1) * chunk, numbers.size());
      std::size_t first = part * chunk;
      while (first > 0 && first < next_part && star_at(first) == star_at(first - 1)) {
        ++first;
      }
      while (first < next_part) {
        std::size_t last = first + 1;
        while (last < numbers.size() && star_at(last) == star_at(first)) {
          ++last;
        }
        // Sorts a copy, because the thread of the next part reads the entries at its beginning.
        of_star.assign(numbers.begin() + static_cast<std::ptrdiff_t>(first),
                       numbers.begin() + static_cast<std::ptrdiff_t>(last));
        if (order == FindingOrder::of_chance) {
          sort_by_place(found, of_star);
        }
        add_without_twins(found, of_star, pixel, parts[part]);
        first = last;
      }
    }
  });
  std::vector<StarImage> images;
  images.reserve(numbers.size());
  for (const std::vector<StarImage>& part : parts) {
    images.insert(images.end(), part.begin(), part.end());
  }
  return images;
}

}  // namespace ergodome
