#include "render/eyes/stereo_rig.h"

#include <algorithm>
#include <cmath>

#include "kernels/core/angles.h"
#include "kernels/spacetime/kerr/kerr.h"

namespace ergodome {

namespace {

//! The unit vectors of r, θ and φ at a position, as rows, in the axes of the Cartesian-like
//! coordinates.
struct Axes {
  double row[3][3];
};

Axes axes_at(double theta, double phi) {
  const double st = std::sin(theta);
  const double ct = std::cos(theta);
  const double sp = std::sin(phi);
  const double cp = std::cos(phi);
  return {{{st * cp, st * sp, ct}, {ct * cp, ct * sp, -st}, {-sp, cp, 0.0}}};
}

}  // namespace

EyeEvent eye_event(Spacetime spacetime, double r, double theta, double phi, const double (&frame_from_view)[3][3],
                   const Vector3<double>& offset, const EyeRoom& room) {
  const KerrFunctions f = kerr_functions(spacetime, r, theta);
  // Converts proper lengths to coordinate displacements: √(Δ/Σ) dr, in the rain frame √A/Σ dr; r dθ
  // = r/√Σ, r sinθ dφ = r √(Σ/A).
  const double outwards = room.in_rain ? std::sqrt(f.area) / f.sigma : std::sqrt(std::max(f.delta, 0.0) / f.sigma);
  const double scale[3] = {outwards, r / std::sqrt(f.sigma), r / f.circumference_factor};
  // With room.in_rain, uses the azimuth of ingoing Kerr coordinates, in which infalling observers
  // move straight in. The Boyer-Lindquist azimuth diverges at the horizon.
  const auto turn_at = [&](double radius) {
    return room.in_rain && radius > horizon_radius(spacetime) ? ingoing_turn(spacetime, radius) : 0.0;
  };
  const double azimuth_here = phi + turn_at(r);
  const Axes here = axes_at(theta, azimuth_here);
  double position[3];
  for (int j = 0; j < 3; ++j) {
    position[j] = r * here.row[0][j];
    for (int i = 0; i < 3; ++i) {
      const double along =
          frame_from_view[i][0] * offset.x + frame_from_view[i][1] * offset.y + frame_from_view[i][2] * offset.z;
      position[j] += along * scale[i] * here.row[i][j];
    }
  }
  EyeEvent eye{};
  const double across = std::hypot(position[0], position[1]);
  eye.r = std::max(std::hypot(across, position[2]), room.min_r);
  eye.theta = std::atan2(across, position[2]);
  // Chooses the azimuth within half a turn of the head's, so that it does not jump in a show with
  // many turns.
  const double azimuth = across > 0.0 ? std::atan2(position[1], position[0]) : azimuth_here;
  const double azimuth_there = azimuth_here + std::remainder(azimuth - azimuth_here, full_turn);
  eye.phi = azimuth_there - turn_at(eye.r);
  const Axes there = axes_at(eye.theta, azimuth_there);
  for (int i = 0; i < 3; ++i) {
    for (int view = 0; view < 3; ++view) {
      double sum = 0.0;
      for (int k = 0; k < 3; ++k) {
        for (int j = 0; j < 3; ++j) {
          sum += there.row[i][j] * here.row[k][j] * frame_from_view[k][view];
        }
      }
      eye.frame_from_view[i][view] = sum;
    }
  }
  return eye;
}

}  // namespace ergodome
