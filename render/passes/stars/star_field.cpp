#include "render/passes/stars/star_field.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "kernels/core/angles.h"

namespace ergodome {

namespace {

//! Each level contains the brightest stars of the previous level; the number of stars is reduced by
//! this factor.
constexpr std::size_t level_ratio = 4;
constexpr std::size_t min_stars = 64;
//! Approximate mean number of stars per cell.
constexpr double stars_a_cell = 1.0;
constexpr int max_bands = 2048;
//! Stars are counted in `counted_steps` steps of ln illuminance, each `counted_step` wide, from the
//! dimmest star on, but not from below `log_min_counted`.
constexpr int counted_steps = 512;
constexpr float counted_step = 0.05F;
constexpr float log_min_counted = -60.0F;
//! B-V of stars without a measured color.
constexpr float unknown_colour = 0.3F;
//! Colors outside this range are measurement errors; Ballesteros' formula is not valid there.
constexpr float bluest = -0.4F;
constexpr float reddest = 5.0F;

FieldStar field_star(const CatalogueStar& star, const glm::dmat3& sky_from_equatorial, const BlackbodyTable& colours) {
  const Vector3<double> d = equatorial_direction(star.ra_deg, star.dec_deg);
  const glm::dvec3 turned = sky_from_equatorial * glm::dvec3(d.x, d.y, d.z);
  const float colour = std::isfinite(star.b_v) ? std::clamp(star.b_v, bluest, reddest) : unknown_colour;
  const double temperature_k = star_temperature(static_cast<double>(colour));
  const double illuminance = illuminance_of_magnitude_0 * std::pow(10.0, -0.4 * static_cast<double>(star.v_mag));
  const auto log_temperature = static_cast<float>(std::log(temperature_k));
  // The illuminance of a disk is its luminance times its solid angle.
  const double luminance = std::exp(static_cast<double>(read_blackbody(colours, log_temperature).x));
  const double radius = std::sqrt(illuminance / (pi * luminance));
  return {{turned.x, turned.y, turned.z},
          log_temperature,
          static_cast<float>(illuminance),
          static_cast<float>(radius),
          star.number};
}

int band_of(double z, int bands) { return cell_among(0.5 * (z + 1.0), bands); }

double azimuth_turns(const Vector3<double>& d) {
  const double turns = std::atan2(d.y, d.x) / (2.0 * pi);
  return turns - std::floor(turns);
}

}  // namespace

StarField::StarField(const StarCatalogue& catalogue, const glm::dmat3& sky_from_equatorial,
                     const BlackbodyTable& colours)
    : gains_(colours) {
  stars_.reserve(catalogue.stars.size());
  for (const CatalogueStar& star : catalogue.stars) {
    stars_.push_back(field_star(star, sky_from_equatorial, colours));
  }
  std::ranges::stable_sort(stars_, std::ranges::greater(), &FieldStar::illuminance);
  count_classes();
  std::vector<int> brightest(stars_.size());
  std::iota(brightest.begin(), brightest.end(), 0);
  for (std::size_t count = stars_.size(); count > 0; count = count > min_stars ? count / level_ratio : 0) {
    brightest.resize(count);
    levels_.push_back(level_of(brightest));
    levels_.back().left_out = count < stars_.size() ? stars_[count].illuminance : 0.0F;
  }
}

StarField::Level StarField::level_of(const std::vector<int>& numbers) const {
  Level level;
  const double side = std::sqrt(static_cast<double>(numbers.size()) / (2.0 * stars_a_cell));
  level.bands = std::clamp(static_cast<int>(side), 1, max_bands);
  level.cells = 2 * level.bands;
  std::vector<std::pair<int, int>> placed;
  placed.reserve(numbers.size());
  for (const int number : numbers) {
    const Vector3<double>& d = stars_[static_cast<std::size_t>(number)].direction;
    placed.emplace_back(band_of(d.z, level.bands) * level.cells + cell_among(azimuth_turns(d), level.cells), number);
  }
  std::ranges::sort(placed);
  level.first.assign(static_cast<std::size_t>(level.bands) * static_cast<std::size_t>(level.cells) + 1, 0);
  for (const auto& [cell, number] : placed) {
    const FieldStar& star = stars_[static_cast<std::size_t>(number)];
    level.first[static_cast<std::size_t>(cell) + 1] += 1;
    level.number.push_back(number);
    level.direction[0].push_back(static_cast<float>(star.direction.x));
    level.direction[1].push_back(static_cast<float>(star.direction.y));
    level.direction[2].push_back(static_cast<float>(star.direction.z));
    level.illuminance.push_back(star.illuminance);
    level.colour.push_back(static_cast<std::uint8_t>(star_class(star.log_temperature)));
  }
  std::partial_sum(level.first.begin(), level.first.end(), level.first.begin());
  for (std::vector<float>* padded :
       {&level.direction[0], &level.direction[1], &level.direction[2], &level.illuminance}) {
    padded->resize(padded->size() + star_padding);
  }
  return level;
}

void StarField::count_classes() {
  max_gain_.assign(static_cast<std::size_t>(ShiftGains::unshifted_row()) + 1, 0.0F);
  if (stars_.empty()) {
    return;
  }
  log_dimmest_ = std::max(std::log(stars_.back().illuminance), log_min_counted);
  for (const FieldStar& star : stars_) {
    ClassCounts& counts = counts_[static_cast<std::size_t>(star_class(star.log_temperature))];
    counts.resize(counted_steps);
    const float position = (std::log(star.illuminance) - log_dimmest_) / counted_step;
    counts[static_cast<std::size_t>(std::clamp(position, 0.0F, static_cast<float>(counted_steps - 1)))] += 1;
  }
  for (std::size_t colour = 0; colour < counts_.size(); ++colour) {
    ClassCounts& counts = counts_[colour];
    std::partial_sum(counts.rbegin(), counts.rend(), counts.rbegin());
    for (std::size_t row = 0; row < max_gain_.size() && !counts.empty(); ++row) {
      max_gain_[row] = std::max(max_gain_[row], gains_.row(static_cast<int>(row)).gain[colour]);
    }
  }
}

int StarField::count_from(const StarFloor& floor) const {
  const ShiftGain& gain = gains_.row(floor.shift_row);
  const float log_min = std::log(std::max(floor.illuminance, 1e-37F)) - log_dimmest_;
  int count = 0;
  for (std::size_t colour = 0; colour < counts_.size(); ++colour) {
    if (!counts_[colour].empty()) {
      const float position = (log_min - gain.log_gain[colour]) * (1.0F / counted_step);
      // The last step counts all brighter stars too.
      count +=
          counts_[colour][static_cast<std::size_t>(std::clamp(position, 0.0F, static_cast<float>(counted_steps - 1)))];
    }
  }
  return count;
}

}  // namespace ergodome
