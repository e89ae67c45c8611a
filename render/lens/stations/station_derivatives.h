#pragma once

#include <functional>
#include <glm/mat3x3.hpp>
#include <vector>

#include "content/trajectory/lens_station.h"
#include "render/lens/stations/place_turn.h"

namespace ergodome {

//! Traces the station's nodes, at their (γ, s), for a camera at another place with its own chart.
using NodeTracer = std::function<std::vector<float>(const LensPlace& place, const LensChart& chart)>;

//! Fills nodes_along_r and nodes_along_theta.
//!
//! Central differences of nodes 1 % of the way to the horizon off (next to it and within it, of a quarter of that to the inner one), and 0.01 rad, with the turn taken out: what they miss is far below
//! what a linear step of that length misses.
void add_derivatives(LensStation& station, const NodeTracer& trace);

//! The nodes of a camera that is `offset` away from a station with derivatives, to first order, and then turned.
std::vector<float> moved_nodes(const LensStation& station, const LensPlace& offset, const glm::dmat3& turn);

}  // namespace ergodome
