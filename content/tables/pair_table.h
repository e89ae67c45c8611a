#pragma once

#include <filesystem>
#include <istream>
#include <string>
#include <vector>

namespace ergodome {

//! An observer and a point in one plane through a hole without spin, and which of the light rays between them is meant; M = 1.
struct PairRow {
  std::string text;         //!< the four numbers as they were written, between commas
  std::string place;        //!< file and line, for messages
  double r_observer = 0.0;  //!< [M]
  double r = 0.0;           //!< [M]
  double phi = 0.0;         //!< azimuth of the point, the observer's is 0 [rad]
  int order = 1;            //!< 1: the direct image; 2: light round the other side; 3: once more round; ...
  double angle = 0.0;       //!< azimuth that the ray sweeps [rad]
};

//! Images of higher order differ from the shadow's edge by less than double precision.
inline constexpr int highest_order = 16;

//! Reads a table of pairs (CSV with a header; columns r_obs, r, phi, order; others are ignored). Throws Error with file and line for missing
//! columns, what is not a number, radii that are not outside the horizon, azimuths that are neither in [0, 2π] nor ones that the ray of that
//! order sweeps, orders that are not whole numbers from 1 to 16, and pairs without a ray.
std::vector<PairRow> read_pair_table(const std::filesystem::path& path);

//! The same from a stream; `file` is how messages call it.
std::vector<PairRow> read_pair_table(std::istream& stream, const std::string& file);

}  // namespace ergodome
