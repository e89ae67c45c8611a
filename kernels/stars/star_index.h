#pragma once

namespace ergodome {

//! Cells that a cell of a star index is parted into; the coarsest level has 16 for each face of a cube.
inline constexpr int star_cell_children = 16;
inline constexpr int coarsest_star_cells = 6 * star_cell_children;
//! 100 million cells are more than stars fit into memory.
inline constexpr int star_level_limit = 6;

//! Cells of one size: cones of the sky that hold them.
struct StarIndexLevel {
  const float* axis[3];    //!< unit vectors
  const float* sine;       //!< of the half angles
  const float* brightest;  //!< greatest illuminance inside [lx]; negative without stars
};

//! Lanes read so many elements past the end of an index's arrays.
inline constexpr int star_index_padding = 16;

//! Stars by their place on the sky. Those of the finest level's cell i are first[i] to first[i + 1] - 1, the brightest first.
struct StarIndex {
  int level_count;
  StarIndexLevel level[star_level_limit];
  const int* first;
  const float* direction[3];  //!< unit vectors
  const float* illuminance;   //!< [lx]
};

//! Stars of at least `faintest` lx within planes through the sky's middle.
struct StarSearchBatch {
  StarIndex index;
  float inward[5][3];  //!< unit vectors: stars have no negative part along any
  float faintest;      //!< not negative
  int* found;          //!< room for all stars
  int* count;          //!< of those found
};

}  // namespace ergodome
