#pragma once

#include "kernels/disk/layer_limits.h"
#include "kernels/launch/kernel.h"
#include "kernels/lens/grid_build.h"

// Grids of a camera's sky that store where its light crosses the equatorial plane, order by order.
namespace ergodome {

//! Number of crossing orders that a grid stores, as many as rays find
//! (kernels/disk/equatorial_crossings.h).
inline constexpr int layer_orders = 3;

//! A grid as kernels read it: the cells of kernels/lens/lens_grid.h over the chart of
//! kernels/disk/disk_chart.h, with one bicubic patch per leaf.
//!
//! Without a pattern, one set of nodes has (u_0, u_1, u_2, 0), where u_n is 1/r at the crossing of
//! order n, with derivatives by γ and s and the mixed one as in LensGrid. With a pattern there is a
//! set for each order, of (u, cosφ, sinφ, delay), with azimuth and delay minus the winding
//! (kernels/spacetime/kerr/horizon_winding.h).
struct DiskGrid {
  LensGrid cells;  //!< the cells; the member `nodes` is not used
  const float* nodes[layer_orders];
  //! For each leaf: bit n is set if the disk's n-th image may be seen in the leaf.
  const unsigned char* orders;
  //! Inverse of the affine distance of each order in the rain frame, (q_0, q_1, q_2, 0) with the
  //! same derivatives; nullptr if not requested.
  const float* nearness;
};

//! The disk's range of 1/r, and the minimum changes per pixel by which a grid's errors of 1/r and
//! of the pattern are divided to convert them to displacements in pixels.
struct DiskSpanOnScreen {
  float outer_u;
  float inner_u;
  //! An error of 1/r is converted to pixels by dividing it by the change of 1/r across a pixel, or
  //! by this value if the change is smaller.
  float min_change;
  //! Minimum divisor for the pattern, like min_change for 1/r: minimum change of azimuth across a
  //! pixel [rad].
  float min_turn;
};

//! The camera of all kernels that trace a disk's grid, in the rain frame at φ = 0.
struct DiskGridCamera {
  GridCamera<float> grid;  //!< camera and chart; the member `settings` is not used
  LayerLimits<float> limits;
  bool pattern;
};

//! Nodes to trace; the members `nodes` and `nearness` have the format of DiskGrid.
struct DiskNodeBatch {
  DiskGridCamera camera;
  int count;
  const float* gamma_turns;
  const float* s;
  float* nodes[layer_orders];
  float* nearness;  //!< as in DiskGrid; nullptr if not requested
};

//! Cells to check by traced rays, as in CheckBatch.
struct DiskCheckBatch {
  DiskGridCamera camera;
  AberrationOf<float> observer;  //!< observer on whose screen errors are measured
  float pixel;                   //!< angle that a pixel of that screen subtends [rad]
  DiskSpanOnScreen span;
  int count;  //!< number of checks: checks_a_cell for each cell
  const GridCell* cells;
  const float* nodes[layer_orders];
  //! Largest displacement on the screen, over all orders, of lines of equal radius and of the
  //! pattern; one value per check.
  float* error_px;
  float* area_px;              //!< the cell's area on the screen [px²]
  float* u[layer_orders];      //!< 1/r at the checks
  float* width[layer_orders];  //!< change of 1/r across a pixel at the checks
};

//! Value that marks an error of unknown size [px].
inline constexpr float unknown_disk_error = 1e30F;

//! Positions in a grid's chart at which the finished grid is compared with traced rays.
struct DiskGridCheckBatch {
  DiskGridCamera camera;
  DiskGrid grid;
  AberrationOf<float> observer;  //!< observer on whose screen errors are measured
  float pixel;                   //!< angle that a pixel of that screen subtends [rad]
  DiskSpanOnScreen span;
  int count;
  const float* gamma_turns;
  const float* s;
  //! Largest displacement on the screen, as in DiskCheckBatch [px]. 0 where the leaf is flagged as
  //! inaccurate, because its pixels are traced. unknown_disk_error where the grid lacks an image
  //! that the ray sees.
  float* error_px;
  //! Area on the screen of a chart area of one turn of γ times one unit of s [px²]; 0 where no
  //! image of the disk is near.
  float* area_px;
};

template <>
struct Kernel<DiskNodeBatch> : KernelDefaults {
  static constexpr int grain = grid_grain;
  static const char* name(const DiskNodeBatch& /*batch*/) { return "trace_disk_nodes"; }
  static int elements(const DiskNodeBatch& batch) { return batch.count; }

  template <class Visit>
  static void visit_outputs(const DiskNodeBatch& batch, const Visit& visit) {
    for (int set = 0; set < (batch.camera.pattern ? layer_orders : 1); ++set) {
      visit("nodes", batch.nodes[set], static_cast<long>(batch.count) * floats_a_node);
    }
  }
};

template <>
struct Kernel<DiskCheckBatch> : KernelDefaults {
  static constexpr int grain = grid_grain;
  static const char* name(const DiskCheckBatch& /*batch*/) { return "check_disk_cells"; }
  static int elements(const DiskCheckBatch& batch) { return batch.count; }

  template <class Visit>
  static void visit_outputs(const DiskCheckBatch& batch, const Visit& visit) {
    visit("error_px", batch.error_px, batch.count);
    visit("area_px", batch.area_px, batch.count);
  }
};

template <>
struct Kernel<DiskGridCheckBatch> : KernelDefaults {
  static constexpr int grain = grid_grain;
  static const char* name(const DiskGridCheckBatch& /*batch*/) { return "check_disk_grid"; }
  static int elements(const DiskGridCheckBatch& batch) { return batch.count; }

  template <class Visit>
  static void visit_outputs(const DiskGridCheckBatch& batch, const Visit& visit) {
    visit("error_px", batch.error_px, batch.count);
    visit("area_px", batch.area_px, batch.count);
  }
};

}  // namespace ergodome
