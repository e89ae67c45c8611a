#pragma once

#include <span>
#include <string>

#include "content/tables/ray_table.h"

namespace ergodome {

//! Options of the table of shell crossings.
struct ShellTableOptions {
  double r = 0.0;            //!< radius of the shell [M]
  double tolerance = 1e-15;  //!< tolerance of the integrator
};

//! Header line of the table that `trace --shell` writes.
inline constexpr const char* shell_table_head = "id,crossing,theta_hit,phi_hit,mino_time,delay,outwards,g_zamo\n";

//! Returns a line for each crossing of a shell by rays that share a camera, the nearest to the
//! camera first: θ and φ [rad], φ in (-π, π]; Mino time from there to the camera for a photon of
//! energy 1 at the camera [1/M]; coordinate time from there to the camera [M]; 1 if the light moves
//! outward there, otherwise 0; g = ν_observed / ν_emitted for a ZAMO on the shell. Throws Error for
//! a shell that is not outside the horizon, and for rays that do not converge.
std::string shell_lines(const RayTable& table, std::span<const RayRow> rows, const ShellTableOptions& options);

}  // namespace ergodome
