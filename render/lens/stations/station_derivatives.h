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

//! Fills nodes_along_r, nodes_along_theta, nodes_along_r_r and nodes_along_r_theta so that the
//! result of moved_nodes() is exact at the station and at the four corners of a cell of camera
//! positions. They are 0 for nodes that do not see the sky from all five positions. `reach`: half
//! the extent of the cell along r [M] and θ [rad].
void add_cell_motion(LensStation& station, const LensPosition& reach, const NodeTracer& trace);

//! Returns the nodes for a camera at `offset` from a station that has derivatives, extrapolated with
//! all coefficients that the station has, and rotated by `turn`.
std::vector<float> moved_nodes(const LensStation& station, const LensPosition& offset, const glm::dmat3& turn);

}  // namespace ergodome
