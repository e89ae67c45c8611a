#pragma once

#include "kernels/core/angles.h"
#include "kernels/spacetime/schwarzschild/connection_table.h"

// The three steps that fill a table; each needs the results of the one before.
namespace ergodome::inline ERGO_TARGET {

//! Solves the rays of a fan, one per index.
struct SolveConnectionFan {
  ConnectionBatch batch;

  ERGO_HD void operator()(int index) const {
    const ConnectionGrid& grid = batch.grid;
    const int column = index % fan_columns(grid);
    const int line = index / fan_columns(grid);
    const double u = fan_u(grid, line % grid.fan_rows);
    const double u_observer = observer_u(grid, line / grid.fan_rows);
    const double angle = pi * column / fan_steps_to_pi;
    if (u == u_observer && column == 0) {
      batch.fan[index] = {0.0, 0.0, 0.0, 1.0 - 2.0 * u};
      return;
    }
    const ConnectingRay ray = connecting_ray(1.0 / u_observer, 1.0 / u, angle);
    const double scaled = ray.travel_time * u * u_observer;
    batch.fan[index] = {scaled * ::cos(ray.xi), scaled * ::sin(ray.xi), scaled * ::cos(ray.emission_angle),
                        ray.affine_distance / ray.travel_time};
  }
};

//! Interpolates a fan to the rows of its table, one row and fan column per index: the polynomial
//! through all Chebyshev points, by the barycentric formula. J.-P. Berrut & L. N. Trefethen, SIAM
//! Review 46 (2004) 501, eq. 5.4.
struct SpreadConnectionRows {
  ConnectionBatch batch;

  ERGO_HD void operator()(int index) const {
    const ConnectionGrid& grid = batch.grid;
    const int column = index % fan_columns(grid);
    const int line = index / fan_columns(grid);
    const int row = line % grid.rows;
    const int layer = line / grid.rows;
    const double u = grid.u_low + (grid.u_high - grid.u_low) * row / (grid.rows - 1);
    const UnroundedNode* const fan = batch.fan + static_cast<long>(layer) * grid.fan_rows * fan_columns(grid) + column;
    double weights = 0.0;
    UnroundedNode sum{0.0, 0.0, 0.0, 0.0};
    for (int i = 0; i < grid.fan_rows; ++i) {
      const UnroundedNode& position = fan[static_cast<long>(i) * fan_columns(grid)];
      const double apart = u - fan_u(grid, i);
      if (::fabs(apart) < 1e-14 * u) {
        sum = position;
        weights = 1.0;
        break;
      }
      const double weight = (i % 2 == 0 ? 1.0 : -1.0) * (i == 0 || i == grid.fan_rows - 1 ? 0.5 : 1.0) / apart;
      weights += weight;
      sum.add(weight, position);
    }
    batch.spread[index] = {sum.x / weights, sum.y / weights, sum.z / weights, sum.distance / weights};
  }
};

//! Interpolates rows to the nodes of a table, one per index, through ten rays of the row, by the
//! same formula.
struct FillConnectionNodes {
  ConnectionBatch batch;

  ERGO_HD void operator()(int index) const {
    const ConnectionGrid& grid = batch.grid;
    const int column = index % (grid.columns + 1);
    const UnroundedNode* const row = batch.spread + static_cast<long>(index / (grid.columns + 1)) * fan_columns(grid);
    const double at = static_cast<double>(grid.orders) * fan_steps_to_pi * column / grid.columns;
    const int first = static_cast<int>(at) - fan_stencil / 2 + 1;
    UnroundedNode sum{0.0, 0.0, 0.0, 0.0};
    double weights = 0.0;
    for (int i = 0; i < fan_stencil; ++i) {
      // The barycentric weights of evenly spaced points are binomial coefficients with alternating
      // signs.
      constexpr double binomial[fan_stencil] = {1.0, -9.0, 36.0, -84.0, 126.0, -126.0, 84.0, -36.0, 9.0, -1.0};
      const int from = first + i;
      const double apart = at - from;
      UnroundedNode position = row[from < 0 ? -from : from];
      position.y = from < 0 ? -position.y : position.y;
      if (apart == 0.0) {
        sum = position;
        weights = 1.0;
        break;
      }
      const double weight = binomial[i] / apart;
      weights += weight;
      sum.add(weight, position);
    }
    batch.nodes[index] = {static_cast<float>(sum.x / weights), static_cast<float>(sum.y / weights),
                          static_cast<float>(sum.z / weights), static_cast<float>(sum.distance / weights)};
  }
};

}  // namespace ergodome::inline ERGO_TARGET
