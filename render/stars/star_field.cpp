#include "render/stars/star_field.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "kernels/core/angles.h"
#include "kernels/launch/launch.h"
#include "kernels/sky/cube_map.h"

namespace ergodome {

namespace {

//! Stars that a finest cell holds on average, at the most: some registers full, of which most are the brightest alone.
constexpr double stars_a_cell = 96.0;
//! B-V of a star whose colour nobody measured.
constexpr float unknown_colour = 0.3F;
//! Colours beyond these are errors of measurement; Ballesteros' formula means nothing there.
constexpr float bluest = -0.4F;
constexpr float reddest = 5.0F;

int levels_for(std::size_t stars) {
  int levels = 1;
  double room = coarsest_star_cells * stars_a_cell;
  while (levels < star_level_limit && room < static_cast<double>(stars)) {
    ++levels;
    room *= star_cell_children;
  }
  return levels;
}

//! Halvings of a cube's face, each way, that lead to the cells of a level.
int halvings_of(int level) { return 2 * (level + 1); }

FieldStar field_star(const CatalogueStar& star, const glm::dmat3& sky_from_map, const BlackbodyTable& colours) {
  const Vector3<double> d = equatorial_direction(star.ra_deg, star.dec_deg);
  const glm::dvec3 turned = sky_from_map * glm::dvec3(d.x, d.y, d.z);
  const float colour = std::isfinite(star.b_v) ? std::clamp(star.b_v, bluest, reddest) : unknown_colour;
  const double temperature_k = star_temperature(static_cast<double>(colour));
  const double illuminance = illuminance_of_magnitude_0 * std::pow(10.0, -0.4 * static_cast<double>(star.v_mag));
  const auto log_temperature = static_cast<float>(std::log(temperature_k));
  // A disk of luminance Y shines with Y times its solid angle.
  const double luminance = std::exp(static_cast<double>(read_blackbody(colours, log_temperature).x));
  const double radius = std::sqrt(illuminance / (pi * luminance));
  return {{turned.x, turned.y, turned.z},
          log_temperature,
          static_cast<float>(illuminance),
          static_cast<float>(radius),
          star.number};
}

//! Number of the cell that a direction lies in after some halvings; those of cell i are 4 i to 4 i + 3.
int cell_of(const Vector3<double>& direction, int depth) {
  const CubePlace<double> place = cube_place<double>(direction);
  int index = static_cast<int>(place.face);
  double x = 0.5 * (place.x + 1.0);
  double y = 0.5 * (place.y + 1.0);
  for (int level = 0; level < depth; ++level) {
    x *= 2.0;
    y *= 2.0;
    const int right = x >= 1.0 ? 1 : 0;
    const int up = y >= 1.0 ? 1 : 0;
    x -= right;
    y -= up;
    index = 4 * index + 2 * up + right;
  }
  return index;
}

struct Cone {
  Vector3<double> axis;
  double sine;  //!< of its half angle
};

//! The cone about a cell's middle that holds its corners, and, as its sides bulge less than that, a little more.
Cone cell_cone(int halvings, int index) {
  int face = index;
  double x = 0.0;
  double y = 0.0;
  double size = 1.0;
  for (int at = 0; at < halvings; ++at) {
    const int child = face % 4;
    face /= 4;
    const int right = child % 2;
    const int up = child / 2;
    x = 0.5 * (x + right);
    y = 0.5 * (y + up);
    size *= 0.5;
  }
  const auto direction = [&](double across, double up) {
    const Vector3<double> d = cube_direction(face, 2.0 * (x + across * size) - 1.0, 2.0 * (y + up * size) - 1.0);
    return (1.0 / std::sqrt(dot(d, d))) * d;
  };
  Cone cone{direction(0.5, 0.5), 0.0};
  double cosine = 1.0;
  for (const double across : {0.0, 0.5, 1.0}) {
    for (const double up : {0.0, 0.5, 1.0}) {
      cosine = std::min(cosine, dot(cone.axis, direction(across, up)));
    }
  }
  cone.sine = std::sin(1.02 * std::acos(cosine) + 1e-6);
  return cone;
}

}  // namespace

StarField::StarField(const StarCatalogue& catalogue, const glm::dmat3& sky_from_map, const BlackbodyTable& colours) {
  const int levels = levels_for(catalogue.stars.size());
  std::vector<std::pair<int, FieldStar>> placed;
  placed.reserve(catalogue.stars.size());
  for (const CatalogueStar& star : catalogue.stars) {
    const FieldStar made = field_star(star, sky_from_map, colours);
    placed.emplace_back(cell_of(made.direction, halvings_of(levels - 1)), made);
  }
  std::ranges::stable_sort(placed, [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first < b.first : a.second.illuminance > b.second.illuminance;
  });
  make_cells(levels);
  add_stars(placed);
  tell_coarser_cells();
  illuminances_ = illuminance_;
  std::ranges::sort(illuminances_, std::ranges::greater());
  for (std::vector<float>* padded : {&direction_[0], &direction_[1], &direction_[2], &illuminance_}) {
    padded->resize(padded->size() + star_index_padding);
  }
}

void StarField::make_cells(int levels) {
  int count = coarsest_star_cells;
  for (int level = 0; level < levels; ++level) {
    Level cells;
    for (int i = 0; i < count; ++i) {
      const Cone cone = cell_cone(halvings_of(level), i);
      const double axis[3] = {cone.axis.x, cone.axis.y, cone.axis.z};
      for (std::size_t part = 0; part < 3; ++part) {
        cells.axis[part].push_back(static_cast<float>(axis[part]));
      }
      cells.sine.push_back(static_cast<float>(cone.sine));
    }
    cells.brightest.assign(static_cast<std::size_t>(count), -1.0F);
    levels_.push_back(std::move(cells));
    count *= star_cell_children;
  }
}

void StarField::add_stars(const std::vector<std::pair<int, FieldStar>>& placed) {
  Level& finest = levels_.back();
  first_.assign(finest.sine.size() + 1, 0);
  for (const auto& [cell, star] : placed) {
    const auto at = static_cast<std::size_t>(cell);
    first_[at + 1] += 1;
    finest.brightest[at] = std::max(finest.brightest[at], star.illuminance);
    stars_.push_back(star);
    direction_[0].push_back(static_cast<float>(star.direction.x));
    direction_[1].push_back(static_cast<float>(star.direction.y));
    direction_[2].push_back(static_cast<float>(star.direction.z));
    illuminance_.push_back(star.illuminance);
  }
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
}

void StarField::tell_coarser_cells() {
  for (std::size_t level = levels_.size() - 1; level > 0; --level) {
    const std::vector<float>& finer = levels_[level].brightest;
    std::vector<float>& coarser = levels_[level - 1].brightest;
    for (std::size_t i = 0; i < finer.size(); ++i) {
      float& brightest = coarser[i / star_cell_children];
      brightest = std::max(brightest, finer[i]);
    }
  }
  for (Level& level : levels_) {
    for (std::vector<float>* padded : {&level.axis[0], &level.axis[1], &level.axis[2], &level.sine, &level.brightest}) {
      padded->resize(padded->size() + star_index_padding);
    }
  }
}

std::size_t StarField::count_from(float illuminance) const {
  return static_cast<std::size_t>(std::ranges::upper_bound(illuminances_, illuminance, std::ranges::greater()) -
                                  illuminances_.begin());
}

StarIndex StarField::index() const {
  StarIndex index{};
  index.level_count = static_cast<int>(levels_.size());
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    const Level& level = levels_[i];
    index.level[i] = {
        {level.axis[0].data(), level.axis[1].data(), level.axis[2].data()}, level.sine.data(), level.brightest.data()};
  }
  index.first = first_.data();
  for (int part = 0; part < 3; ++part) {
    index.direction[part] = direction_[part].data();
  }
  index.illuminance = illuminance_.data();
  return index;
}

int StarField::search(const SkyFrustum& part, float faintest, std::vector<int>& found) const {
  // Once, so that neither the kernel need ask for room nor each search clear it.
  if (found.size() < stars_.size()) {
    found.resize(stars_.size());
  }
  int count = 0;
  StarSearchBatch batch{index(), {}, std::max(faintest, 0.0F), found.data(), &count};
  for (int side = 0; side < 5; ++side) {
    const Vector3<double>& inward = part.inward[side];
    batch.inward[side][0] = static_cast<float>(inward.x);
    batch.inward[side][1] = static_cast<float>(inward.y);
    batch.inward[side][2] = static_cast<float>(inward.z);
  }
  search_stars(batch);
  return count;
}

}  // namespace ergodome
