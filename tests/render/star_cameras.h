#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/lens/grid_builder.h"
#include "render/stars/star_pass.h"

namespace ergodome::test {

inline constexpr double pi = 3.14159265358979323846;
//! A pixel of a 4096² dome.
inline constexpr double fine_pixel = pi / 4096;

struct Place {
  double spin, r, theta, phi;
  ObserverMotion motion;
};

//! The cameras of the tests: a fast hole from its equator, near a photon orbit, and from high above in a falling frame.
inline const Place places[] = {{0.999, 5.0, pi / 2, 0.7, ObserverMotion::geodesic},
                               {0.5, 3.2, 1.2, -2.0, ObserverMotion::zamo},
                               {0.9, 12.0, 0.4, 4.0, ObserverMotion::rain}};

inline EyeCamera eye_at(const Place& place) {
  EyeCamera eye{place.spin, place.r, place.theta, place.phi, place.motion, {}, {}, place.r, place.theta};
  const double at_hole[3][3] = {{0, 0, 1}, {0, -1, 0}, {1, 0, 0}};
  std::copy(&at_hole[0][0], &at_hole[0][0] + 9, &eye.frame_from_view[0][0]);
  return eye;
}

inline CameraStation camera_of(const EyeCamera& eye) {
  return make_camera_station(eye.spin, eye.r, eye.theta, eye.phi, eye.motion, eye.velocity);
}

inline const BlackbodyColours& colours() {
  static const BlackbodyColours table(Backend::cpu);
  return table;
}

inline StarCatalogue brightest(std::size_t count) {
  Show show;
  show.sky.stars = "all_stars";
  StarCatalogue catalogue = load_stars(show);
  catalogue.stars.resize(count);
  return catalogue;
}

inline StarSettings settings_for(double faintest_mag) {
  StarSettings settings;
  settings.pixel = fine_pixel;
  settings.redshift = false;
  settings.faintest = static_cast<float>(illuminance_of_magnitude_0 * std::pow(10.0, -0.4 * faintest_mag));
  return settings;
}

inline std::vector<StarImage> images_of(const StarField& field, const EyeCamera& eye, const StarSettings& settings) {
  GridSettings grid;
  grid.pixel = settings.pixel;
  grid.budget_px = 1.0;
  grid.least_area_px = 4.0;
  grid.fine = false;
  grid.observer = aberration_to_rain(eye.spin, eye.r, eye.theta, eye.motion, eye.velocity);
  const LensStation station = build_lens_station(eye.spin, eye.r, eye.theta, grid);
  return find_star_images(field, colours().view(), eye, station,
                          star_patches(field, colours().view(), eye, station, settings), settings);
}

inline Vector3<double> widened(const Vector3<float>& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

inline Vector3<double> unit_of(const Vector3<double>& v) { return (1.0 / std::sqrt(dot(v, v))) * v; }

}  // namespace ergodome::test
