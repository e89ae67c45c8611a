#include "render/stars/star_field.h"

#include <algorithm>
#include <cmath>

#include "kernels/sky/cube_map.h"

namespace ergodome {

namespace {

//! Stars that a finest cell holds on average.
constexpr double stars_a_cell = 12.0;
constexpr int deepest_level = 8;
//! B-V of a star whose colour nobody measured.
constexpr float unknown_colour = 0.3F;
//! Colours beyond these are errors of measurement; Ballesteros' formula means nothing there.
constexpr float bluest = -0.4F;
constexpr float reddest = 5.0F;

int depth_for(std::size_t stars) {
  int depth = 0;
  double room = 6.0 * stars_a_cell;
  while (depth < deepest_level && room < static_cast<double>(stars)) {
    ++depth;
    room *= 4.0;
  }
  return depth;
}

FieldStar field_star(const CatalogueStar& star, const glm::dmat3& sky_from_map, const BlackbodyTable& colours) {
  const Vector3<double> d = equatorial_direction(star.ra_deg, star.dec_deg);
  const glm::dvec3 turned = sky_from_map * glm::dvec3(d.x, d.y, d.z);
  const float colour = std::isfinite(star.b_v) ? std::clamp(star.b_v, bluest, reddest) : unknown_colour;
  const double temperature_k = star_temperature(static_cast<double>(colour));
  const double illuminance = illuminance_of_magnitude_0 * std::pow(10.0, -0.4 * static_cast<double>(star.v_mag));
  const auto log_temperature = static_cast<float>(std::log(temperature_k));
  // A disk of luminance Y shines with Y times its solid angle.
  const double luminance = std::exp(static_cast<double>(read_blackbody(colours, log_temperature).x));
  const double radius = std::sqrt(illuminance / (3.14159265358979 * luminance));
  return {{turned.x, turned.y, turned.z},
          log_temperature,
          static_cast<float>(illuminance),
          static_cast<float>(radius),
          star.number};
}

//! Number of the cell of a level that a direction lies in; children of cell i are 4 i to 4 i + 3.
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

//! The cone about a cell's middle that holds its corners, and, as its sides bulge less than that, a little more.
SkyCell empty_cell(int level, int index) {
  int face = index;
  double x = 0.0;
  double y = 0.0;
  double size = 1.0;
  for (int at = 0; at < level; ++at) {
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
  SkyCell cell{direction(0.5, 0.5), 0.0, 0, 0, 0.0F};
  double cosine = 1.0;
  for (const double across : {0.0, 0.5, 1.0}) {
    for (const double up : {0.0, 0.5, 1.0}) {
      cosine = std::min(cosine, dot(cell.axis, direction(across, up)));
    }
  }
  cell.sine = std::sin(1.02 * std::acos(cosine) + 1e-6);
  return cell;
}

}  // namespace

StarField::StarField(const StarCatalogue& catalogue, const glm::dmat3& sky_from_map, const BlackbodyTable& colours) {
  const int depth = depth_for(catalogue.stars.size());
  std::vector<std::pair<int, FieldStar>> placed;
  placed.reserve(catalogue.stars.size());
  for (const CatalogueStar& star : catalogue.stars) {
    const FieldStar made = field_star(star, sky_from_map, colours);
    placed.emplace_back(cell_of(made.direction, depth), made);
  }
  std::ranges::stable_sort(placed, [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first < b.first : a.second.illuminance > b.second.illuminance;
  });
  make_cells(depth);
  stars_.reserve(placed.size());
  illuminances_.reserve(placed.size());
  for (const auto& [cell, star] : placed) {
    SkyCell& into = levels_.back()[static_cast<std::size_t>(cell)];
    into.first = into.last == 0 ? static_cast<int>(stars_.size()) : into.first;
    into.last = static_cast<int>(stars_.size()) + 1;
    into.brightest = std::max(into.brightest, star.illuminance);
    stars_.push_back(star);
    illuminances_.push_back(star.illuminance);
  }
  std::ranges::sort(illuminances_, std::ranges::greater());
  for (int level = depth - 1; level >= 0; --level) {
    auto& cells = levels_[static_cast<std::size_t>(level)];
    const auto& finer = levels_[static_cast<std::size_t>(level) + 1];
    for (std::size_t i = 0; i < cells.size(); ++i) {
      for (std::size_t child = 4 * i; child < 4 * i + 4; ++child) {
        cells[i].brightest = std::max(cells[i].brightest, finer[child].brightest);
      }
    }
  }
}

std::size_t StarField::count_from(float illuminance) const {
  return static_cast<std::size_t>(std::ranges::upper_bound(illuminances_, illuminance, std::ranges::greater()) -
                                  illuminances_.begin());
}

void StarField::make_cells(int depth) {
  for (int level = 0; level <= depth; ++level) {
    const int count = 6 << (2 * level);
    std::vector<SkyCell> cells;
    cells.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
      cells.push_back(empty_cell(level, i));
    }
    levels_.push_back(std::move(cells));
  }
}

}  // namespace ergodome
