#pragma once

#include "kernels/core/angles.h"
#include "kernels/core/host_device.h"
#include "kernels/spacetime/schwarzschild/connecting_ray.h"

// A table of connecting rays, after Müller, Schulz & Weiskopf (2021), section 3.1: over u = 1/r and
// the azimuth φ that the ray sweeps, for one observer or for several radii. The axis of φ covers
// two or more image orders, because the rays are smooth at φ = π.
//
// It stores apparent positions: x = t cos ξ, y = t sin ξ, and z = t cos ζ with the emission angle
// ζ, all divided by r and by the observer's radius. These are normal coordinates of light's
// geometry, smooth wherever there is light. This includes the observer's position, where ξ itself
// takes every value. In flat space x = u_obs cos φ - u, y = u_obs sin φ, z = u cos φ - u_obs, which
// interpolation reproduces. x and z are even in φ, y is odd. The table also stores the affine
// distance over t, which is smooth and even too, and 1 - 2u at the observer's position.
//
// The rays of a fan are solved at few u (Chebyshev's points) and few φ, evenly spaced; high-order
// interpolation yields the nodes. A node is in float: its rounding moves ξ by about 1e-7 rad.
namespace ergodome {

//! Nodes of a table. The ends of the axes are nodes.
struct ConnectionGrid {
  double u_low, u_high;  //!< range of u = 1/r of the points [1/M]
  //! Range of 1/r of the observers [1/M]; both equal for one observer.
  double u_observer_low, u_observer_high;
  int rows;      //!< number of nodes in u, 4 or more
  int columns;   //!< number of steps in φ from 0 to its maximum, 4 or more
  int layers;    //!< number of observers' radii: 1, or 4 or more
  int fan_rows;  //!< values of u at which rays are solved
  int orders;    //!< number of half turns that φ covers
};

struct ConnectionNode {
  float x, y, z;
  float distance;
};

//! Values of a node in double, before rounding to float.
struct UnroundedNode {
  double x, y, z;
  double distance;

  ERGO_HD void add(double weight, const UnroundedNode& other) {
    x += weight * other.x;
    y += weight * other.y;
    z += weight * other.z;
    distance += weight * other.distance;
  }
};

//! A table under construction.
struct ConnectionBatch {
  ConnectionGrid grid;
  UnroundedNode* fan;     //!< solved rays, indexed [layer][fan row][fan column]
  UnroundedNode* spread;  //!< fan interpolated to all rows, indexed [layer][row][fan column]
  ConnectionNode* nodes;  //!< finished nodes, indexed [layer][row][column], with columns + 1 columns
};

//! A table for reading.
struct ConnectionView {
  ConnectionGrid grid;
  const ConnectionNode* nodes;
};

//! Number of steps between the rays of a fan from φ = 0 to π, and number of rays that an
//! interpolation uses. The interpolation error is then below the rounding of float.
inline constexpr int fan_steps_to_pi = 20;
inline constexpr int fan_stencil = 10;

//! The ray that connects a point with the observer, as interpolated from a table.
struct SeenPoint {
  double xi;               //!< angle ξ at the observer, as in ConnectingRay [rad]
  double travel_time;      //!< coordinate time from the point to the observer [M]
  double emission_angle;   //!< angle at the point, as in ConnectingRay [rad]
  double affine_distance;  //!< as in ConnectingRay [M]
};

inline namespace ERGO_TARGET {

//! Returns the number of rays in a row of the fan: from φ = 0 to its end, and the ones beyond that
//! the stencil needs.
ERGO_HD int fan_columns(const ConnectionGrid& grid) { return grid.orders * fan_steps_to_pi + fan_stencil / 2 + 1; }

ERGO_HD double observer_u(const ConnectionGrid& grid, int layer) {
  const double share = grid.layers > 1 ? static_cast<double>(layer) / (grid.layers - 1) : 0.0;
  return grid.u_observer_low + share * (grid.u_observer_high - grid.u_observer_low);
}

//! Returns u of a fan row: Chebyshev's points of the second kind, which include the ends.
ERGO_HD double fan_u(const ConnectionGrid& grid, int fan_row) {
  const double sine = ::sin(0.5 * pi * fan_row / (grid.fan_rows - 1));
  return grid.u_low + (grid.u_high - grid.u_low) * sine * sine;
}

//! Returns whether a table contains a point; a table for one observer contains that one only.
ERGO_HD bool covers(const ConnectionGrid& grid, double r_observer, double r, double angle) {
  constexpr double slack = 1.0 + 1e-12;
  const double u = 1.0 / r;
  const double u_observer = 1.0 / r_observer;
  return u * slack >= grid.u_low && u <= grid.u_high * slack && angle >= 0.0 && angle <= pi * grid.orders * slack &&
         u_observer * slack >= grid.u_observer_low && u_observer <= grid.u_observer_high * slack;
}

namespace detail {

//! Four neighbors on an axis and Lagrange's cubic weights.
struct CubicStencil {
  int first;
  double weight[4];
};

ERGO_HD CubicStencil cubic_stencil(double at, int minimum, int last) {
  CubicStencil stencil{};
  stencil.first = static_cast<int>(::fmax(minimum, ::fmin(last - 3, ::floor(at) - 1.0)));
  const double t = at - stencil.first;
  stencil.weight[0] = -(t - 1.0) * (t - 2.0) * (t - 3.0) / 6.0;
  stencil.weight[1] = 0.5 * t * (t - 2.0) * (t - 3.0);
  stencil.weight[2] = -0.5 * t * (t - 1.0) * (t - 3.0);
  stencil.weight[3] = t * (t - 1.0) * (t - 2.0) / 6.0;
  return stencil;
}

//! Interpolates one layer in u and φ.
ERGO_HD UnroundedNode read_layer(const ConnectionView& view, int layer, const CubicStencil& row,
                                 const CubicStencil& column) {
  UnroundedNode sum{0.0, 0.0, 0.0, 0.0};
  const long width = view.grid.columns + 1;
  for (int i = 0; i < 4; ++i) {
    const ConnectionNode* const line = view.nodes + (static_cast<long>(layer) * view.grid.rows + row.first + i) * width;
    for (int j = 0; j < 4; ++j) {
      const int at = column.first + j;
      const ConnectionNode& node = line[at < 0 ? -at : at];
      const double weight = row.weight[i] * column.weight[j];
      const double side = at < 0 ? -1.0 : 1.0;
      sum.add(weight, {static_cast<double>(node.x), side * static_cast<double>(node.y), static_cast<double>(node.z),
                       static_cast<double>(node.distance)});
    }
  }
  return sum;
}

}  // namespace detail

//! Reads a point that the table `covers`, by cubic interpolation in u, φ and, with several
//! observers, the observer's u.
ERGO_HD SeenPoint look_up_connection(const ConnectionView& view, double r_observer, double r, double angle) {
  const ConnectionGrid& grid = view.grid;
  const double u = 1.0 / r;
  const detail::CubicStencil row =
      detail::cubic_stencil((u - grid.u_low) / (grid.u_high - grid.u_low) * (grid.rows - 1), 0, grid.rows - 1);
  const detail::CubicStencil column =
      detail::cubic_stencil(angle / (pi * grid.orders) * grid.columns, -1, grid.columns);
  UnroundedNode position = detail::read_layer(view, 0, row, column);
  if (grid.layers > 1) {
    const double share = (1.0 / r_observer - grid.u_observer_low) / (grid.u_observer_high - grid.u_observer_low);
    const detail::CubicStencil layer = detail::cubic_stencil(share * (grid.layers - 1), 0, grid.layers - 1);
    position = {0.0, 0.0, 0.0, 0.0};
    for (int i = 0; i < 4; ++i) {
      position.add(layer.weight[i], detail::read_layer(view, layer.first + i, row, column));
    }
  }
  // Both ends have the same b: sin ζ √(1 - 2/r)^-1 r = sin ξ √(1 - 2/r_obs)^-1 r_obs.
  const double emitted_y = position.y * detail::lapse(r) * r_observer / (detail::lapse(r_observer) * r);
  const double time = r * r_observer * ::hypot(position.x, position.y);
  return {::atan2(position.y, position.x), time, ::atan2(emitted_y, position.z), position.distance * time};
}

}  // namespace ERGO_TARGET

//! Makes a table of connecting rays on all CPU threads: solves its fans and interpolates them to
//! the nodes. See ConnectionBatch.
void make_connection_table(const ConnectionBatch& batch);

}  // namespace ergodome
