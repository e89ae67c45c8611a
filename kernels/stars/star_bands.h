#pragma once

namespace ergodome {

//! Lanes read so many elements past the end of the arrays of stars.
inline constexpr int star_padding = 16;

//! Stars by their place on the sky: in bands of equal height in z from the south pole up, in each by their azimuth. Cell `cell` of a band,
//! of `cells` that are equally wide, has the stars first[band * cells + cell] to first[band * cells + cell + 1] - 1.
struct StarBands {
  int bands;
  int cells;
  const int* first;
  const float* direction[3];  //!< unit vectors
  const float* illuminance;   //!< [lx]
};

//! Stars of at least `faintest` lx in some cells of some bands, and within planes through the sky's middle.
struct StarSearchBatch {
  StarBands stars;
  int first_band;
  int last_band;       //!< the band after the last
  int first_cell;      //!< in 0 to cells - 1
  int cell_count;      //!< `cells` at the most; they go on round the sky
  float inward[4][3];  //!< unit vectors: stars have no negative part along any
  float faintest;      //!< not negative
  int* found;          //!< room for all stars: their numbers in the bands' order
  int* count;          //!< of those found
};

}  // namespace ergodome
