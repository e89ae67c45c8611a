#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernels/core/angles.h"
#include "render/lens/grid/grid_builder.h"
#include "render/passes/stars/star_pass.h"

// Cameras, star fields and settings for tests of stars.
namespace ergodome::test {

//! Angle of a pixel of a 4096² dome [rad].
inline constexpr double fine_pixel = pi / 4096;

struct CameraState {
  double spin, r, theta, phi;
  ObserverMotion motion;
};

//! Cameras for tests of stars: at the equator of a fast-spinning hole, near a photon orbit, and at
//! a high latitude in free fall.
inline const CameraState positions[] = {{0.999, 5.0, pi / 2, 0.7, ObserverMotion::geodesic},
                                        {0.5, 3.2, 1.2, -2.0, ObserverMotion::zamo},
                                        {0.9, 12.0, 0.4, 4.0, ObserverMotion::rain}};

inline EyeCamera eye_at_position(const CameraState& position) {
  EyeCamera eye{Spacetime{position.spin},
                position.r,
                position.theta,
                position.phi,
                position.motion,
                {},
                {},
                position.r,
                position.theta};
  const double at_hole[3][3] = {{0, 0, 1}, {0, -1, 0}, {1, 0, 0}};
  std::copy(&at_hole[0][0], &at_hole[0][0] + 9, &eye.frame_from_view[0][0]);
  return eye;
}

inline CameraStation camera_of(const EyeCamera& eye) {
  return make_camera_station(eye.spacetime, eye.r, eye.theta, eye.phi, eye.motion, eye.velocity);
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
  const LensStation station = build_star_station(eye, settings);
  return find_star_images(field, colours().view(), eye, station,
                          star_patches(field, colours().view(), eye, station, settings), settings);
}

inline Vector3<double> widened(const Vector3<float>& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

inline Vector3<double> unit_of(const Vector3<double>& v) { return (1.0 / std::sqrt(dot(v, v))) * v; }

//! Returns the illuminance that the light of all pixels of a picture adds up to [lx].
inline double light_of(const std::vector<float>& rgba, const Projection& projection) {
  using D = Dual<double>;
  double sum = 0.0;
  for (int y = 0; y < projection.height_px; ++y) {
    for (int x = 0; x < projection.width_px; ++x) {
      const Vector3<D> n = direction_from_pixel(projection, D(x + 0.5, 1.0, 0.0), D(y + 0.5, 0.0, 1.0));
      const Vector3<double> area = cross(Vector3<double>{n.x.along_x, n.y.along_x, n.z.along_x},
                                         Vector3<double>{n.x.along_y, n.y.along_y, n.z.along_y});
      const std::size_t i = 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(projection.width_px) +
                                 static_cast<std::size_t>(x));
      sum += static_cast<double>(rgba[i + 1]) * std::sqrt(dot(area, area));
    }
  }
  return sum;
}

}  // namespace ergodome::test
