#include "content/sky/sky_map.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "content/show/show_errors.h"
#include "kernels/core/angles.h"
#include "kernels/core/error.h"
#include "kernels/launch/parallel_for.h"

namespace ergodome {

namespace {

double nearest_line_deg(double angle_deg, double step_deg) { return std::abs(std::remainder(angle_deg, step_deg)); }

//! Returns 1 on a line and 0 beside it, with an edge that is one texel soft.
double line(double distance_deg, double half_width_deg, double texel_deg) {
  return std::clamp((half_width_deg - distance_deg) / texel_deg + 0.5, 0.0, 1.0);
}

glm::dvec3 grid_colour(double latitude_deg, double longitude_deg, double texel_deg) {
  constexpr glm::dvec3 hues[4] = {{0.35, 0.10, 0.08}, {0.30, 0.26, 0.06}, {0.06, 0.24, 0.12}, {0.07, 0.13, 0.38}};
  const int quadrant = std::clamp(static_cast<int>(longitude_deg / 90.0), 0, 3);
  const double shade = latitude_deg > 0.0 ? 0.55 : 0.16;
  glm::dvec3 colour = hues[quadrant] * shade;
  const double parallel = line(nearest_line_deg(latitude_deg, 15.0), 0.35, texel_deg);
  const double stretch = 1.0 / std::max(std::cos(latitude_deg * pi / 180.0), 1e-3);
  // Near the poles only every sixth meridian continues, so that the lines do not fill the pole.
  const double step_deg = std::abs(latitude_deg) > 75.0 ? 90.0 : 15.0;
  const double meridian =
      line(nearest_line_deg(longitude_deg, step_deg), 0.35 * std::min(stretch, 40.0), texel_deg * stretch);
  colour = glm::mix(colour, glm::dvec3(0.75, 0.78, 0.8), std::max(parallel, meridian));
  const double equator = line(std::abs(latitude_deg), 0.7, texel_deg);
  colour = glm::mix(colour, glm::dvec3(0.9, 0.75, 0.2), equator);
  const double from_pole_deg = 90.0 - std::abs(latitude_deg);
  const double ring = line(std::abs(from_pole_deg - 3.0), 0.8, texel_deg);
  return glm::mix(colour, latitude_deg > 0.0 ? glm::dvec3(1.0) : glm::dvec3(0.9, 0.05, 0.05), ring);
}

//! Reverses the order of the texels in each row.
void turn_rows_round(EnvironmentImage& image) {
  const std::ptrdiff_t row = 3 * static_cast<std::ptrdiff_t>(image.width);
  for (auto first = image.rgb.begin(); first != image.rgb.end(); first += row) {
    auto last = first + row;
    for (auto left = first; left + 3 < last; left += 3) {
      last -= 3;
      std::swap_ranges(left, left + 3, last);
    }
  }
}

}  // namespace

std::filesystem::path built_in_content_folder() {
  namespace fs = std::filesystem;
  std::error_code problem;
  if (const char* const chosen = std::getenv("ERGODOME_CONTENT"); chosen != nullptr && *chosen != '\0') {
    if (!fs::is_directory(fs::path(chosen) / "maps", problem)) {
      throw Error(std::string("ERGODOME_CONTENT ") + chosen, "contains no built-in content",
                  "set it to the folder content/ of the project, or unset it");
    }
    return chosen;
  }
  const fs::path program = fs::read_symlink("/proc/self/exe", problem).parent_path();
  // Candidates, in order: relative to an installed program; the source tree in which the program
  // was built; relative to a program in a build folder of a source tree that was moved
  // (build/PRESET/app).
  const fs::path candidates[] = {program / "../share/ergodome/content", fs::path(ERGODOME_CONTENT_DIR),
                                 program / "../../../content"};
  for (const fs::path& folder : candidates) {
    if (fs::is_directory(folder / "maps", problem)) {
      return folder;
    }
  }
  throw Error("built-in content", "was not found",
              "reinstall the program, or set ERGODOME_CONTENT to the folder content/ of the project");
}

bool is_built_in_sky(const std::string& name) { return name == "grid" || name == "milky_way" || name == "black"; }

EnvironmentImage load_sky_map(const Show& show) {
  if (show.sky.map == "grid") {
    return make_grid_sky(2048);
  }
  if (show.sky.map == "milky_way") {
    return read_environment_image(built_in_content_folder() / "maps" / "milky_way.jpg");
  }
  if (show.sky.map == "black") {
    return make_black_sky();
  }
  return read_named(show, "sky.map", show.sky.map, [&](const std::filesystem::path& path) {
    std::error_code problem;
    if (!std::filesystem::exists(layered_file(path).path, problem)) {
      throw Error(show.sky.map.empty() ? "\"\"" : path.string(), "does not exist",
                  "give a built-in sky (milky_way, grid, black) or the path of an image");
    }
    EnvironmentImage image = read_environment_image(path);
    if (show.sky.map_layout.mirrored) {
      turn_rows_round(image);
    }
    return image;
  });
}

EnvironmentImage make_black_sky() {
  constexpr int width = 16;
  EnvironmentImage image;
  image.name = "black";
  image.width = width;
  image.height = width / 2;
  image.rgb.resize(3UL * width * width / 2);
  return image;
}

EnvironmentImage make_grid_sky(int width) {
  EnvironmentImage image;
  image.name = "grid";
  image.width = width;
  image.height = width / 2;
  image.rgb.resize(3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  const double texel_deg = 360.0 / width;
  std::vector<double> longitude_deg;
  longitude_deg.reserve(static_cast<std::size_t>(width));
  for (int x = 0; x < image.width; ++x) {
    const glm::dvec3 d = direction_from_map((x + 0.5) / image.width, 0.5);
    longitude_deg.push_back(std::fmod(std::atan2(d.y, d.x) * 180.0 / pi + 360.0, 360.0));
  }
  parallel_for(image.height, 16, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const glm::dvec3 d = direction_from_map(0.5, (y + 0.5) / image.height);
      const double latitude_deg = std::asin(std::clamp(d.z, -1.0, 1.0)) * 180.0 / pi;
      std::size_t i = 3 * static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width);
      for (const double longitude : longitude_deg) {
        const glm::dvec3 colour = grid_colour(latitude_deg, longitude, texel_deg);
        image.rgb[i++] = static_cast<float>(colour.x);
        image.rgb[i++] = static_cast<float>(colour.y);
        image.rgb[i++] = static_cast<float>(colour.z);
      }
    }
  });
  return image;
}

glm::dmat3 sky_from_map(const SkySettings& sky) {
  return sky_from_equatorial(sky) * equatorial_from_map(sky.map_layout);
}

glm::dmat3 sky_from_equatorial(const SkySettings& sky) {
  if (sky.map == "grid") {
    return glm::dmat3(1.0);
  }
  const double ra = sky.spin_axis_ra_deg * pi / 180.0;
  const double dec = sky.spin_axis_dec_deg * pi / 180.0;
  const glm::dvec3 axis(std::cos(dec) * std::cos(ra), std::cos(dec) * std::sin(ra), std::sin(dec));
  // The sky's x axis is the direction in which the declination decreases along the meridian through
  // the spin axis. It is also defined at the poles.
  const glm::dvec3 x(std::sin(dec) * std::cos(ra), std::sin(dec) * std::sin(ra), -std::cos(dec));
  return glm::transpose(glm::dmat3(x, glm::cross(axis, x), axis));
}

glm::dvec3 direction_from_map(double u, double v) {
  const double ra = pi / 2.0 - 2.0 * pi * u;
  const double dec = pi / 2.0 - pi * v;
  return {std::cos(dec) * std::cos(ra), std::cos(dec) * std::sin(ra), std::sin(dec)};
}

glm::dvec2 map_from_direction(const glm::dvec3& direction) {
  const double u = (pi / 2.0 - std::atan2(direction.y, direction.x)) / (2.0 * pi);
  const double v = (pi / 2.0 - std::atan2(direction.z, std::hypot(direction.x, direction.y))) / pi;
  return {u - std::floor(u), v};
}

}  // namespace ergodome
