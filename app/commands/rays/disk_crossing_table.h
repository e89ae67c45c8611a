#pragma once

#include <span>
#include <string>

#include "content/tables/ray_table.h"

namespace ergodome {

//! Options of the table of disk crossings.
struct CrossingTableOptions {
  double tolerance = 1e-15;  //!< tolerance of the integrator
  bool plunging = false;     //!< gives g also inside the ISCO, for matter that plunges from there
};

//! Header line of the table that `trace --disk` writes.
inline constexpr const char* crossing_table_head = "id,order,r_hit,phi_hit,delay,g_kepler\n";

//! Returns a line for each of the first three crossings of the equatorial plane, for rays that
//! share a camera: r_hit [M], phi_hit in (-π, π], delay (coordinate time from emission to the
//! camera [M]), and g_kepler = ν_observed / ν_emitted for matter on a circular geodesic along +φ,
//! which is empty inside the ISCO unless `plunging`. Throws Error for rays that do not converge.
std::string crossing_lines(const RayTable& table, std::span<const RayRow> rows, const CrossingTableOptions& options);

}  // namespace ergodome
