#pragma once

#include <filesystem>
#include <istream>
#include <string>

#include "kernels/launch/large_memory.h"
#include "kernels/spacetime/kerr/observer.h"

namespace ergodome {

//! A light ray to trace: the hole's spin, a camera at φ = 0, its observer, and a direction.
struct RayRow {
  std::string id;  //!< as in the file; the row's index from 0 if the file has no such column
  Spacetime spacetime;
  double r = 0.0;      //!< camera's Boyer-Lindquist radius [M]
  double theta = 0.0;  //!< camera's polar angle [rad]
  ObserverMotion motion = ObserverMotion::zamo;
  Vector3<double>
      //! Velocity in the ZAMO frame for ObserverMotion::velocity ("boost"), in the rain frame for
      //! rain_boost.
      velocity{};
  Vector3<double> direction{};  //!< unit vector in the observer's frame (e_r, e_θ, e_φ)
};

using RayRows = LargeVector<RayRow>;

//! Reads a table of rays (CSV with a header; columns a or spin, r, theta or theta_deg, observer,
//! n_r, n_theta, n_phi, and beta_r, beta_theta, beta_phi for the observers "boost" and
//! "rain_boost"; `id` is optional, others are ignored).
//!
//! Throws Error with file and line for missing columns (those of a velocity only if a row needs
//! them), invalid numbers, cameras inside the horizon unless the observer is rain or rain_boost,
//! cameras too close to the inner horizon, observers that cannot exist, velocities that differ from
//! that of the named observer, and directions of zero length.
RayRows read_ray_table(const std::filesystem::path& path);

//! Reads a table of rays from a stream; `file` is its name in messages. Without `need_directions`
//! (for points on the edge of the shadow), n_* may be absent. Reserves memory for `expected_rows`.
RayRows read_ray_table(std::istream& stream, const std::string& file, bool need_directions = true,
                       std::size_t expected_rows = 0);

}  // namespace ergodome
