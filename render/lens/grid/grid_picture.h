#pragma once

#include <cstdint>
#include <vector>

#include "content/trajectory/lens_station.h"

// Draws lens grids.

namespace ergodome {

//! Number of leaves of a grid whose cells result from the same number of halvings.
struct GridLevel {
  int halvings = 0;  //!< number of halvings along γ and s together
  int leaves = 0;
  int flagged = 0;
};

//! Counts the leaves of a grid by number of halvings, from the smallest number that occurs.
std::vector<GridLevel> grid_levels(const LensStation& station);

//! Draws the cells of a grid over the camera's whole sky in the rain frame, with the shadow's
//! center in the middle and the far pole of the chart on the rim. Returns display-referred RGB
//! bytes, size_px x size_px, top row first.
//!
//! The color of a leaf is its maximum error at the check points, from 0 (dark) to `budget_px`
//! (light). Leaves left to rays are red, the shadow is black, and sides of cells are lines one
//! pixel wide.
std::vector<std::uint8_t> draw_grid(const LensStation& station, int size_px, double budget_px);

}  // namespace ergodome
