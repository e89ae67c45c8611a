#pragma once

#include "kernels/disk/layer_limits.h"
#include "kernels/lens/grid_build.h"
#include "kernels/near_field/draw_near_field.h"

// Grids of a camera's sky that hold where its light crosses the equatorial plane, order by order.
namespace ergodome {

//! Orders that a grid holds: those that rays find (kernels/disk/equatorial_crossings.h).
inline constexpr int layer_orders = 3;

//! A grid as kernels read it: the cells of kernels/lens/lens_grid.h over the chart of kernels/disk/disk_chart.h, a bicubic patch a leaf.
//!
//! Without a pattern one set of nodes has (u_0, u_1, u_2, 0) and their derivatives; with one there is a set for each order, of (u, cosφ, sinφ, delay),
//! azimuth and delay less what the horizon winds (kernels/near_field/horizon_winding.h).
struct DiskGrid {
  LensGrid cells;  //!< its `nodes` are not used
  const float* nodes[layer_orders];
  const unsigned char* orders;  //!< for each leaf: bit n says that the disk's n-th image may be seen there
  //! 1 over the affine distance of each order in the rain frame, (q_0, q_1, q_2, 0) and their derivatives; nullptr where nobody asked for them.
  const float* nearness;
};

//! The part of the plane that a grid is for, in 1/r, and what its errors are measured by.
struct DiskSpanOnScreen {
  float outer_u;
  float inner_u;
  float least_change;  //!< of 1/r in a pixel: an error is measured as if there were no less
  float least_turn;    //!< of the pattern in a pixel [rad]
};

//! What the kernels that trace a disk's grid share: the camera in the rain frame at φ = 0.
struct DiskGridCamera {
  GridCamera<float> grid;  //!< its settings are not used
  LayerLimits<float> limits;
  bool pattern;
};

//! Nodes to trace: `nodes` as in DiskGrid.
struct DiskNodeBatch {
  DiskGridCamera camera;
  int count;
  const float* gamma_turns;
  const float* s;
  float* nodes[layer_orders];
  float* nearness;  //!< as in DiskGrid; nullptr where nobody asks for them
};

//! Cells to check by traced rays, as CheckBatch does.
struct DiskCheckBatch {
  DiskGridCamera camera;
  AberrationOf<float> observer;  //!< whose screen counts
  float pixel;                   //!< angle of a pixel on that screen [rad]
  DiskSpanOnScreen span;
  int count;  //!< checks: checks_a_cell a cell
  const GridCell* cells;
  const float* nodes[layer_orders];
  float*
      error_px;  //!< displacement on the screen of lines of equal radius, and of the pattern's, the worst of all orders
  float* area_px;              //!< the cell's area on the screen [px²]
  float* u[layer_orders];      //!< 1/r at the checks
  float* width[layer_orders];  //!< how far it changes across a pixel there
};

//! An error of which no more is known than that it is one [px].
inline constexpr float unknown_disk_error = 1e30F;

//! Places of its chart at which a grid is compared with traced rays.
struct DiskGridCheckBatch {
  DiskGridCamera camera;
  DiskGrid grid;
  AberrationOf<float> observer;  //!< whose screen counts
  float pixel;                   //!< angle of a pixel on that screen [rad]
  DiskSpanOnScreen span;
  int count;
  const float* gamma_turns;
  const float* s;
  float*
      error_px;  //!< as in DiskCheckBatch; 0 where the grid leaves the pixel to rays, unknown_disk_error where an image is not told of
  float* area_px;  //!< area on the screen of a turn times a unit of s [px²]; 0 where no image of the disk is near
};

//! A block of rows of one image whose disk is read from a grid. Pixels of leaves that could not be made good are traced; those that show objects are left
//! as they are.
struct DiskLookUpBatch {
  NearFieldBatch near_field;  //!< without shells and eyes that turn
  DiskGrid grid;
  AberrationOf<float> aberration;
};

}  // namespace ergodome
