#pragma once

#include <span>
#include <string>

#include "content/tables/ray_table.h"

namespace ergodome {

//! What a table of a shell's crossings is of.
struct ShellTableOptions {
  double r = 0.0;            //!< radius of the shell [M]
  double tolerance = 1e-15;  //!< of the integrator
};

//! The head of the table that `trace --shell` writes.
inline constexpr const char* shell_table_head = "id,crossing,theta_hit,phi_hit,mino_time,delay,outwards,g_zamo\n";

//! A line for each crossing of a shell by rays that share a camera, the nearest first: θ and φ [rad], φ in (-π, π]; Mino time from there to the
//! camera for a photon that the camera sees with energy 1 [1/M]; coordinate time from there to the camera [M]; 1 where the light goes
//! outwards there, else 0; g = ν_observed / ν_emitted for an observer without angular momentum on the shell. Throws Error for a shell that is
//! not outside the horizon, and for rays that do not converge.
std::string shell_lines(std::span<const RayRow> rows, const ShellTableOptions& options);

}  // namespace ergodome
