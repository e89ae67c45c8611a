#pragma once

#include <span>
#include <string>

#include "content/tables/ray_table.h"

namespace ergodome {

//! What a table of crossings shows beside the places.
struct CrossingTableOptions {
  double tolerance = 1e-15;  //!< of the integrator
  bool plunging = false;     //!< g inside the last stable orbit too, of matter that falls from there
};

//! The head of the table that `trace --disk` writes.
inline constexpr const char* crossing_table_head = "id,order,r_hit,phi_hit,delay,g_kepler\n";

//! A line for each of the first three crossings of the equatorial plane, by rays that share a camera: r_hit [M], phi_hit in (-π, π], delay =
//! coordinate time from emission to camera [M], g_kepler = ν_observed / ν_emitted for matter on a circular geodesic along +φ; empty where
//! there is none, inside the last stable orbit. Throws Error for rays that do not converge.
std::string crossing_lines(std::span<const RayRow> rows, const CrossingTableOptions& options);

}  // namespace ergodome
