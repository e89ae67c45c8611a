#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <istream>
#include <string>
#include <vector>

#include "kernels/launch/large_memory.h"
#include "kernels/spacetime/kerr/observer.h"

namespace ergodome {

//! The camera that sees rays: the hole's spin, a position at φ = 0, and an observer.
struct RayCamera {
  Spacetime spacetime;
  double r = 0.0;      //!< camera's Boyer-Lindquist radius [M]
  double theta = 0.0;  //!< camera's polar angle [rad]
  ObserverMotion motion = ObserverMotion::zamo;
  Vector3<double>
      //! Velocity in the ZAMO frame for ObserverMotion::velocity ("boost"), in the rain frame for
      //! rain_boost.
      velocity{};
};

//! A light ray to trace. Tables have millions of them.
struct RayRow {
  Vector3<double> direction{};  //!< unit vector in the observer's frame (e_r, e_θ, e_φ)
  std::uint32_t camera = 0;     //!< index of its camera in RayTable::cameras
  std::uint32_t number = 0;     //!< index of the row in the file, from 0; empty lines do not count
};

using RayRows = LargeVector<RayRow>;
using LargeText = std::basic_string<char, std::char_traits<char>, LargeAllocator<char>>;

//! Light rays to trace, and their cameras.
struct RayTable {
  std::vector<RayCamera> cameras;
  RayRows rows;
  LargeText ids;                     //!< the ids of all rows, one after the other; empty if the file has no such column
  LargeVector<std::size_t> id_ends;  //!< end of each row's id in `ids`

  [[nodiscard]] const RayCamera& camera_of(const RayRow& row) const { return cameras[row.camera]; }

  //! Returns a row's id as in the file, or its number if the file has no ids.
  [[nodiscard]] std::string id_of(const RayRow& row) const;
};

//! Reads a table of rays (CSV with a header; columns a or spin, r, theta or theta_deg, observer,
//! n_r, n_theta, n_phi, and beta_r, beta_theta, beta_phi for the observers "boost" and
//! "rain_boost"; `id` is optional, others are ignored).
//!
//! Throws Error with file and line for missing columns (those of a velocity only if a row needs
//! them), invalid numbers, cameras inside the horizon unless the observer is rain or rain_boost,
//! cameras too close to the inner horizon, observers that cannot exist, velocities that differ from
//! that of the named observer, and directions of zero length.
RayTable read_ray_table(const std::filesystem::path& path);

//! Reads a table of rays from a stream; `file` is its name in messages. Without `need_directions`
//! (for points on the edge of the shadow), n_* may be absent. Reserves memory for `expected_rows`.
RayTable read_ray_table(std::istream& stream, const std::string& file, bool need_directions = true,
                        std::size_t expected_rows = 0);

}  // namespace ergodome
