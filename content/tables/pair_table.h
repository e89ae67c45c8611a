#pragma once

#include <filesystem>
#include <istream>
#include <string>
#include <vector>

namespace ergodome {

//! An observer and a point in a plane through a hole without spin, and the order of the light ray
//! between them; M = 1.
struct PairRow {
  std::string text;         //!< the four numbers as written, between commas
  std::string location;     //!< file and line, for messages
  double r_observer = 0.0;  //!< the observer's radius coordinate [M]
  double r = 0.0;           //!< the point's radius coordinate [M]
  double phi = 0.0;         //!< azimuth of the point; the observer's is 0 [rad]
  int order = 1;            //!< 1: the direct image; 2: light around the other side; 3: one more way around; ...
  double angle = 0.0;       //!< azimuth about the hole that the ray sweeps [rad]
};

//! Maximum order: images of higher order differ from the shadow's edge by less than double
//! precision.
inline constexpr int highest_order = 16;

//! Reads a table of pairs (CSV with a header; columns r_obs, r, phi, order; others are ignored).
//! Throws Error with file and line for missing columns, invalid numbers, radii not outside the
//! horizon, azimuths outside the range of their order, orders that are not integers from 1 to 16,
//! and pairs without a ray.
std::vector<PairRow> read_pair_table(const std::filesystem::path& path);

//! Reads a table of pairs from a stream; `file` is its name in messages.
std::vector<PairRow> read_pair_table(std::istream& stream, const std::string& file);

}  // namespace ergodome
