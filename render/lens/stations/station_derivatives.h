#pragma once

#include <functional>
#include <glm/mat3x3.hpp>
#include <vector>

#include "content/trajectory/lens_station.h"
#include "render/lens/stations/lens_position.h"

// Derivatives of baked stations with respect to the camera's r and θ.

namespace ergodome {

//! Function that traces the station's nodes, at their (γ, s), for a camera at another position with
//! its own chart.
using NodeTracer = std::function<std::vector<float>(const LensPosition& position, const LensChart& chart)>;

//! Fills nodes_along_r and nodes_along_theta.
//!
//! Takes central differences with steps of ±0.01 rad in θ (limited to [0, π]) and ±1 % of
//! radial_measure() in r, with the rotation of frame_rotation() removed. Their error is far below
//! that of a linear step of the same length.
void add_derivatives(LensStation& station, const NodeTracer& trace);

//! Returns the nodes for a camera at `offset` from a station that has derivatives along the
//! camera's r and θ, extrapolated to first order and rotated by `turn`.
std::vector<float> moved_nodes(const LensStation& station, const LensPosition& offset, const glm::dmat3& turn);

}  // namespace ergodome
