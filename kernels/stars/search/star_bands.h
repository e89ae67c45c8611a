#pragma once

#include <cstdint>

#include "kernels/launch/kernel.h"
#include "kernels/stars/field_star.h"
#include "kernels/stars/search/star_patch.h"

// Stars sorted by position on the sky, and the search for the stars in a part of the sky.
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
  const float* direction[3];  //!< unit vectors to the stars in the hole's sky axes
  const float* illuminance;   //!< [lx]
};

//! Maximum number of levels of a star field; each has a quarter of the previous one's stars.
inline constexpr int max_star_levels = 16;

//! The brightest stars, sorted by their position on the sky.
struct StarLevel {
  StarBands stars;
  const std::int32_t* number;  //!< index of each star in SearchedField::stars
  const std::uint8_t* colour;  //!< star_class() of each star
  float left_out;              //!< illuminance of the brightest star that is not in this level
};

//! A field of stars as the search reads it (render/passes/stars/star_field.h).
struct SearchedField {
  StarLevel levels[max_star_levels];  //!< level 0 has all stars; each further level has fewer
  int level_count;
  const FieldStar* stars;
  const ShiftGain* gains;  //!< table of gains; PatchLight::shift_row selects a row
  const float* max_gain;   //!< maximum gain of the stars in the field, for each row
};

//! Finds the stars that lie in a part of the sky and are brighter than a threshold.
struct StarSearchBatch {
  const SearchedField* field;
  SkyPart part;
  StarFloor floor;
  int* found;  //!< out: indices in SearchedField::stars; needs room for all stars of the field
  int* count;  //!< out: number of stars found
};

template <>
struct Kernel<StarSearchBatch> : KernelDefaults {
  static constexpr bool counted = false;
  static const char* name(const StarSearchBatch& /*batch*/) { return "search_stars"; }
  static int elements(const StarSearchBatch& /*batch*/) { return 1; }
};

inline namespace ERGO_TARGET {

//! Returns which of `parts` equal parts of [0, 1) contains a position; for positions outside [0,
//! 1), returns the first or the last part.
template <class S>
ERGO_HD int cell_among(S position, int parts) {
  const int at = static_cast<int>(position * static_cast<S>(parts));
  return at < 0 ? 0 : at < parts ? at : parts - 1;
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
