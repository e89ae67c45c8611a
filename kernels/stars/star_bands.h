#pragma once

#include "kernels/launch/kernel.h"

// Stars sorted by position on the sky, and the search for those in a part of it.
namespace ergodome {

//! SIMD packs read up to this many elements past the end of the arrays of stars.
inline constexpr int star_padding = 16;

//! Stars sorted by their position on the sky: in bands of equal height in z from the south pole up,
//! and in each band by azimuth. A band has `cells` equally wide cells; cell c of band b has the
//! stars first[b * cells + c] to first[b * cells + c + 1] - 1.
struct StarBands {
  int bands;
  int cells;
  const int* first;
  const float* direction[3];  //!< unit vectors
  const float* illuminance;   //!< [lx]
};

//! Finds stars of at least `faintest` lx in some cells of some bands, and on the inner side of
//! planes through the sky's center.
struct StarSearchBatch {
  StarBands stars;
  int first_band;
  int last_band;       //!< the band after the last
  int first_cell;      //!< in 0 to cells - 1
  int cell_count;      //!< at most `cells`; they wrap round the sky
  float inward[4][3];  //!< unit normals of the planes: no star found is on the negative side of one
  float faintest;      //!< not negative
  //! Out: numbers of stars in the order of the bands; needs room for all stars.
  int* found;
  int* count;  //!< out: number of stars found
};

template <>
struct Kernel<StarSearchBatch> : KernelDefaults {
  static constexpr bool counted = false;
  static const char* name(const StarSearchBatch& /*batch*/) { return "search_stars"; }
  static int elements(const StarSearchBatch& /*batch*/) { return 1; }
};

}  // namespace ergodome
