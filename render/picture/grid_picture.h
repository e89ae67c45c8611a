#pragma once

#include <cstdint>
#include <vector>

#include "content/trajectory/lens_station.h"

namespace ergodome {

//! Number of leaves and nodes-to-be by how often their cell was halved.
struct GridLevel {
  int halvings = 0;  //!< along γ and s together
  int leaves = 0;
  int flagged = 0;
};

//! The leaves of a grid, level by level, from the coarsest that has any.
std::vector<GridLevel> grid_levels(const LensStation& station);

//! Draws the cells of a grid over the camera's whole sky in the rain frame, the shadow's centre in the middle and the far pole of the
//! chart on the rim: display-referred RGB bytes, size_px x size_px, the top row first.
//!
//! A leaf's colour is its greatest error at the check points, from 0 (dark) to `budget_px` (light); what is left to rays is red, the
//! shadow black, a cell's sides are lines one pixel wide.
std::vector<std::uint8_t> draw_grid(const LensStation& station, int size_px, double budget_px);

}  // namespace ergodome
