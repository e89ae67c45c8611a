#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "content/sky/sky_map.h"
#include "kernels/projection/pixel_measure.h"
#include "render/accuracy/axes/axes.h"
#include "render/accuracy/references/exact_images.h"
#include "render/accuracy/statistics.h"
#include "render/passes/stars/drawing/picture_regions.h"
#include "render/passes/stars/search/view_cone.h"
#include "render/passes/stars/star_pass.h"

namespace ergodome {

namespace {

constexpr std::size_t method_count = 2;
//! Maximum distance at which an image is matched with an exact one [px].
constexpr double match_px = 2.0;
//! Maximum magnification of compared images. Next to caustics magnifications are limited by the
//! size of the stars' disks, so that they do not show the accuracy of the method.
constexpr double max_magnification = 1e3;
//! An image is clearly bright if it is brighter than the search limit by this factor. Both methods
//! must find every clearly bright image.
constexpr double clearly_bright = 1.1;

struct Found {
  int star = 0;
  Vector3<double> direction{};
  double magnification = 0.0;
  double brightness = 0.0;
};

Vector3<double> unit_of(const Vector3<float>& v) {
  const Vector3<double> wide = {v.x, v.y, v.z};
  return (1.0 / std::sqrt(dot(wide, wide))) * wide;
}

double luminance(const Vector3<float>& light) {
  return static_cast<double>(0.2126729F * light.x + 0.7151522F * light.y + 0.0721750F * light.z);
}

//! Returns whether a direction is inside the picture, at least a few pixels from its edge.
bool is_inside(const EyeCamera& eye, const Projection& projection, const Vector3<double>& n) {
  const auto along = [&](int axis) {
    return n.x * eye.frame_from_view[0][axis] + n.y * eye.frame_from_view[1][axis] + n.z * eye.frame_from_view[2][axis];
  };
  double x = 0.0;
  double y = 0.0;
  if (!pixel_from_direction(projection, {along(0), along(1), along(2)}, x, y)) {
    return false;
  }
  constexpr double rim_px = 4.0;
  for (const double dx : {-rim_px, rim_px}) {
    for (const double dy : {-rim_px, rim_px}) {
      const bool in_picture =
          x + dx > 0.0 && x + dx < projection.width_px && y + dy > 0.0 && y + dy < projection.height_px;
      if (!in_picture || !(image_coverage(projection, x + dx, y + dy) >= 1.0)) {
        return false;
      }
    }
  }
  return true;
}

//! Searches for the star images of a moment with both methods: invert() and gather().
class StarRace {
 public:
  StarRace(const Show& show, const AccuracyMoment& moment)
      : moment_(moment),
        colours_(Backend::cpu),
        field_(load_stars(show), sky_from_equatorial(moment.show.sky), colours_.view()),
        tree_(field_) {
    settings_.pixel = moment.pixel;
    settings_.faintest =
        static_cast<float>(illuminance_of_magnitude_0 * std::pow(10.0, -0.4 * moment.show.sky.faintest_mag));
    settings_.redshift = moment.show.effects.redshift;
    settings_.magnification = moment.show.effects.magnification;
    settings_.min_cell_px = min_star_cell_px(moment.show.quality.budget_px);
    settings_.view = view_cone(moment.eye, moment.projection, 0.05);
  }

  //! Prepares invert() for a new camera position.
  void prepare() {
    station_ = build_star_station(moment_.eye, settings_);
    patches_.emplace(star_patches(field_, colours_.view(), moment_.eye, station_, settings_));
  }

  void invert() { images_ = find_star_images(field_, colours_.view(), moment_.eye, station_, *patches_, settings_); }

  void gather() {
    images_.clear();
    for (const PictureRegion& region : picture_regions(moment_.projection)) {
      const GatheredStars stars =
          gather_stars(field_, tree_, colours_.view(), moment_.eye, region.projection, settings_);
      const std::vector<StarImage> in_region = star_images(stars.stars, moment_.eye, region.projection);
      images_.insert(images_.end(), in_region.begin(), in_region.end());
    }
  }

  //! Returns the images of the last search that are in the picture (is_inside()).
  [[nodiscard]] std::vector<Found> found() const {
    std::vector<Found> all;
    for (const StarImage& image : images_) {
      const Vector3<double> n = unit_of(image.direction);
      const double brightness = luminance(image.illuminance);
      if (is_inside(moment_.eye, moment_.projection, n)) {
        all.push_back({image.star, n, std::abs(static_cast<double>(image.magnification)), brightness});
      }
    }
    return all;
  }

  [[nodiscard]] bool is_clearly_bright(const Found& found) const {
    return found.brightness > clearly_bright * static_cast<double>(settings_.faintest);
  }

  [[nodiscard]] std::vector<std::optional<ExactImage>> exact(const std::vector<Found>& found) const {
    std::vector<Vector3<double>> stars;
    std::vector<Vector3<double>> directions;
    for (const Found& each : found) {
      stars.push_back(field_.stars()[static_cast<std::size_t>(each.star)].direction);
      directions.push_back(each.direction);
    }
    return exact_images(moment_.eye, stars, directions, match_px * moment_.pixel);
  }

 private:
  const AccuracyMoment& moment_;
  BlackbodyColours colours_;
  StarField field_;
  StarTree tree_;
  StarSettings settings_;
  LensStation station_;
  std::optional<StarPatches> patches_;
  std::vector<StarImage> images_;
};

double distance_px(const Vector3<double>& a, const Vector3<double>& b, double pixel) {
  const Vector3<double> apart = a - b;
  return std::sqrt(dot(apart, apart)) / pixel;
}

//! Errors of a method over all moments, and how many of the `known` exact images it lost.
struct Tally {
  std::vector<double> positions_px;
  std::vector<double> lights;
  std::size_t lost = 0;
  std::size_t known = 0;
};

//! The directions of all clearly bright exact images at a moment, by star; each image once. An
//! exact image counts if an image that either method found was refined to it (exact_images()).
using ExactByStar = std::multimap<int, Vector3<double>>;

void add_exact(ExactByStar& known, int star, const Vector3<double>& n, double pixel) {
  const auto [first, last] = known.equal_range(star);
  if (std::none_of(first, last, [&](const auto& other) { return distance_px(other.second, n, pixel) < 0.05; })) {
    known.emplace(star, n);
  }
}

void compare(const StarRace& race, const std::vector<Found>& found, double pixel, Tally& tally, ExactByStar& known) {
  const std::vector<std::optional<ExactImage>> exact = race.exact(found);
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!exact[i] || exact[i]->magnification > max_magnification) {
      continue;
    }
    tally.positions_px.push_back(distance_px(found[i].direction, exact[i]->direction, pixel));
    tally.lights.push_back(std::abs(found[i].magnification / exact[i]->magnification - 1.0));
    if (race.is_clearly_bright(found[i])) {
      add_exact(known, found[i].star, exact[i]->direction, pixel);
    }
  }
}

void count_lost(const ExactByStar& known, const std::vector<Found>& found, double pixel, Tally& tally) {
  ExactByStar own;
  for (const Found& each : found) {
    own.emplace(each.star, each.direction);
  }
  for (const auto& [star, n] : known) {
    const auto [first, last] = own.equal_range(star);
    const Vector3<double>& position = n;
    const bool has = std::any_of(
        first, last, [&](const auto& other) { return distance_px(other.second, position, pixel) < match_px; });
    tally.lost += has ? 0 : 1;
    ++tally.known;
  }
}

//! Runs both methods in turn, round by round, and adds their times to `results`.
void time(StarRace& race, const AccuracySettings& settings, const AccuracyProgress& progress,
          std::array<Measurement, method_count>& results) {
  for (std::size_t round = 0; round < static_cast<std::size_t>(settings.rounds); ++round) {
    report_progress(progress, "finding stars");
    for (Measurement& result : results) {
      result.frame_ms.resize(std::max(result.frame_ms.size(), round + 1));
      result.prepare_ms.resize(std::max(result.prepare_ms.size(), round + 1));
    }
    const Stopwatch prepare;
    race.prepare();
    results[0].prepare_ms[round] += prepare.elapsed_ms();
    const Stopwatch invert;
    race.invert();
    results[0].frame_ms[round] += invert.elapsed_ms();
    const Stopwatch gather;
    race.gather();
    results[1].frame_ms[round] += gather.elapsed_ms();
  }
}

}  // namespace

std::optional<AccuracyAxis> measure_stars(const Show& show, const std::vector<AccuracyMoment>& moments,
                                          const AccuracySettings& settings, const AccuracyProgress& progress) {
  if (show.sky.stars.empty()) {
    return std::nullopt;
  }
  std::array<Measurement, method_count> results;
  std::array<Tally, method_count> tallies;
  results[0].method = "inverse";
  results[0].setting = "inverse of the lens";
  results[1].method = "gather";
  results[1].setting = "footprint of each pixel";
  results[1].published = "VE";
  for (const AccuracyMoment& moment : moments) {
    report_progress(progress, "exact images of stars");
    StarRace race(show, moment);
    std::array<std::vector<Found>, method_count> found;
    race.prepare();
    race.invert();
    found[0] = race.found();
    race.gather();
    found[1] = race.found();
    ExactByStar known;
    for (std::size_t i = 0; i < method_count; ++i) {
      compare(race, found[i], moment.pixel, tallies[i], known);
    }
    for (std::size_t i = 0; i < method_count; ++i) {
      count_lost(known, found[i], moment.pixel, tallies[i]);
    }
    time(race, settings, progress, results);
  }
  AccuracyAxis axis;
  axis.name = "stars";
  axis.title = "Search for lensed images of stars";
  axis.unit = ErrorUnit::pixels;
  axis.reference =
      "rays in closed form that end at the star. Errors of the light are those of the magnification, for images "
      "magnified less than 1,000 times. Lost images are those that one method finds and another does not";
  for (std::size_t i = 0; i < method_count; ++i) {
    results[i].error = summary_of(std::move(tallies[i].positions_px));
    results[i].light_error = summary_of(std::move(tallies[i].lights));
    results[i].lost =
        tallies[i].known > 0 ? static_cast<double>(tallies[i].lost) / static_cast<double>(tallies[i].known) : 0.0;
    for (std::vector<double>* const times : {&results[i].prepare_ms, &results[i].frame_ms}) {
      for (double& time_ms : *times) {
        time_ms /= static_cast<double>(moments.size());
      }
    }
    axis.choices.push_back(std::move(results[i]));
  }
  return axis;
}

}  // namespace ergodome
