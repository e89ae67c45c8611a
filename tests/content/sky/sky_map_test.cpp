#include "content/sky/sky_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "kernels/core/angles.h"

namespace ergodome {
namespace {

//! Returns the mean light of a built-in map around a position on the sky.
double light_at(const EnvironmentImage& image, double ra_deg, double dec_deg) {
  const glm::dvec3 d(std::cos(dec_deg * one_degree) * std::cos(ra_deg * one_degree),
                     std::cos(dec_deg * one_degree) * std::sin(ra_deg * one_degree), std::sin(dec_deg * one_degree));
  const glm::dvec2 position = map_from_direction(d);
  double sum = 0.0;
  for (int dy = -6; dy <= 6; ++dy) {
    for (int dx = -6; dx <= 6; ++dx) {
      const int x = (static_cast<int>(position.x * image.width) + dx + image.width) % image.width;
      const int y = std::clamp(static_cast<int>(position.y * image.height) + dy, 0, image.height - 1);
      for (int c = 0; c < 3; ++c) {
        sum += image.rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                              static_cast<std::size_t>(x)) +
                         static_cast<std::size_t>(c)];
      }
    }
  }
  return sum;
}

TEST(SkyMap, MilkyWayHasTheMagellanicCloudsAndTheGalacticCentreInTheirPlaces) {
  const EnvironmentImage image = load_sky_map(Show{});
  EXPECT_EQ(image.width, 2048);
  // The mirror image of the Large Magellanic Cloud's position (80.9°, -69.8°) is darker than the
  // cloud; otherwise the map would be mirrored.
  const double lmc = light_at(image, 80.9, -69.8);
  EXPECT_GT(lmc, 3.0 * light_at(image, 80.9, 69.8));
  EXPECT_GT(lmc, 3.0 * light_at(image, -10.0, -60.0));
  // The Small Magellanic Cloud is compared with the position that it would have on a mirrored map.
  EXPECT_GT(light_at(image, 13.2, -72.8), 2.0 * light_at(image, 180.0 - 13.2, -72.8));
  const double centre = light_at(image, 266.4, -29.0);
  EXPECT_GT(centre, 5.0 * light_at(image, 192.9, 27.1));  // the galactic pole
}

TEST(SkyMap, PlacesAndDirectionsAreInverses) {
  for (const double u : {0.0, 0.1, 0.26, 0.5, 0.77, 0.99}) {
    for (const double v : {0.01, 0.3, 0.5, 0.9}) {
      const glm::dvec2 back = map_from_direction(direction_from_map(u, v));
      EXPECT_NEAR(back.x, u, 1e-12);
      EXPECT_NEAR(back.y, v, 1e-12);
    }
  }
}

TEST(SkyMap, RotationPutsTheSpinAxisOnZAndKeepsTheHandedness) {
  SkySettings sky;
  for (const double dec_deg : {-90.0, -20.0, 0.0, 66.6, 90.0}) {
    sky.spin_axis_dec_deg = dec_deg;
    const glm::dmat3 turn = sky_from_map(sky);
    const double ra = sky.spin_axis_ra_deg * one_degree;
    const double dec = dec_deg * one_degree;
    const glm::dvec3 axis(std::cos(dec) * std::cos(ra), std::cos(dec) * std::sin(ra), std::sin(dec));
    EXPECT_NEAR(glm::length(turn * axis - glm::dvec3(0.0, 0.0, 1.0)), 0.0, 1e-12);
    EXPECT_NEAR(glm::determinant(turn), 1.0, 1e-12);
  }
}

glm::dvec3 direction_of(double longitude_deg, double latitude_deg) {
  return {std::cos(latitude_deg * one_degree) * std::cos(longitude_deg * one_degree),
          std::cos(latitude_deg * one_degree) * std::sin(longitude_deg * one_degree),
          std::sin(latitude_deg * one_degree)};
}

//! Returns the distance [arcsec] between a direction on a map in the given coordinates and a
//! direction in J2000 coordinates.
double apart_arcsec(MapCoordinates coordinates, const glm::dvec3& on_map, const glm::dvec3& equatorial) {
  const glm::dvec3 turned = equatorial_from_map({coordinates, 270.0, false}) * on_map;
  return glm::length(turned - equatorial) / one_degree * 3600.0;
}

TEST(MapLayout, GalacticPlacesAreWhereCataloguesHaveThem) {
  // Positions from SIMBAD of Vega, Sirius, the galactic north pole and the galactic center.
  const auto apart = [](double l, double b, double ra, double dec) {
    return apart_arcsec(MapCoordinates::galactic, direction_of(l, b), direction_of(ra, dec));
  };
  EXPECT_LT(apart(67.4482, 19.2372, 279.23474, 38.78369), 1.0);
  EXPECT_LT(apart(227.2303, -8.8903, 101.28716, -16.71612), 1.0);
  EXPECT_LT(apart(0.0, 90.0, 192.85948, 27.12825), 0.1);
  EXPECT_LT(apart(0.0, 0.0, 266.40500, -28.93617), 0.2);
}

TEST(MapLayout, EclipticPlacesAreWhereTheSunIs) {
  const auto apart = [](double longitude, double latitude, double ra, double dec) {
    return apart_arcsec(MapCoordinates::ecliptic, direction_of(longitude, latitude), direction_of(ra, dec));
  };
  EXPECT_LT(apart(0.0, 0.0, 0.0, 0.0), 1e-6);
  EXPECT_LT(apart(90.0, 0.0, 90.0, 23.4392911), 0.01);
  EXPECT_LT(apart(0.0, 90.0, 270.0, 66.5607089), 0.01);
}

TEST(MapLayout, WhatIsInTheMiddleOfThePictureHasTheLongitudeThatItSays) {
  for (const double middle_deg : {0.0, 90.0, 180.0, 270.0, -33.0}) {
    const glm::dmat3 turn = equatorial_from_map({MapCoordinates::equatorial, middle_deg, false});
    EXPECT_LT(glm::length(turn * direction_from_map(0.5, 0.5) - direction_of(middle_deg, 0.0)), 1e-12);
    EXPECT_LT(glm::length(turn * direction_from_map(0.25, 0.5) - direction_of(middle_deg + 90.0, 0.0)), 1e-12);
  }
}

TEST(SkyMap, GridIsBrighterInTheNorthAndHasAHueForEachQuadrant) {
  const EnvironmentImage grid = make_grid_sky(720);
  EXPECT_GT(light_at(grid, 37.0, 37.0), 2.0 * light_at(grid, 37.0, -37.0));
  const auto texel = [&](double ra_deg) {
    const glm::dvec2 position =
        map_from_direction({std::cos(ra_deg * one_degree), std::sin(ra_deg * one_degree), 0.14});
    const std::size_t i =
        3 * (static_cast<std::size_t>(position.y * grid.height) * 720U + static_cast<std::size_t>(position.x * 720));
    return glm::vec3(grid.rgb[i], grid.rgb[i + 1], grid.rgb[i + 2]);
  };
  EXPECT_GT(texel(37.0).x, 2.0F * texel(37.0).z);    // red
  EXPECT_GT(texel(307.0).z, 2.0F * texel(307.0).x);  // blue
}

TEST(SkyMap, BlackHasNoLight) {
  Show show;
  show.sky.map = "black";
  const EnvironmentImage black = load_sky_map(show);
  EXPECT_EQ(black.width, 2 * black.height);
  EXPECT_EQ(black.rgb.size(), 3UL * static_cast<std::size_t>(black.width) * static_cast<std::size_t>(black.height));
  EXPECT_TRUE(std::ranges::all_of(black.rgb, [](float light) { return light == 0.0F; }));
}

}  // namespace
}  // namespace ergodome
