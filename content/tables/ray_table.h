#pragma once

#include <filesystem>
#include <istream>
#include <string>
#include <vector>

#include "kernels/spacetime/kerr/observer.h"

namespace ergodome {

//! One light ray to trace: a hole, a camera at φ = 0, its observer, and a direction.
struct RayRow {
  std::string id;      //!< as in the file; the row's number where the file has no such column
  double spin = 0.0;   //!< [M]
  double r = 0.0;      //!< [M]
  double theta = 0.0;  //!< [rad]
  ObserverMotion motion = ObserverMotion::zamo;
  Vector3<double>
      velocity{};  //!< in the ZAMO frame for ObserverMotion::velocity ("boost"), in the rain's for rain_boost
  Vector3<double> direction{};  //!< unit vector in the observer's frame (e_r, e_θ, e_φ)
};

//! Reads a table of rays (CSV with a header; columns a or spin, r, theta or theta_deg, observer, n_r, n_theta, n_phi, and beta_r, beta_theta, beta_phi
//! for the observers "boost" and "rain_boost"; `id` is optional, others are ignored). Throws Error with file and line for missing columns, those of a velocity where a row has such an observer among them,
//! what is not a number, cameras within the horizon whose observer is no rain, or that are too near to the inner one, observers that cannot
//! exist, directions without length.
std::vector<RayRow> read_ray_table(const std::filesystem::path& path);

//! The same from a stream; `file` is how messages call it. With `need_directions` false (points of the edge) n_* may be absent.
std::vector<RayRow> read_ray_table(std::istream& stream, const std::string& file, bool need_directions = true);

}  // namespace ergodome
