#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

// Portable float maps (http://www.pauldebevec.com/Research/HDR/PFM/, netpbm's pfm(5)) as used for
// warps: "PF", width and height, a scale whose sign states the byte order (negative:
// little-endian), then three floats per sample.
//
// OpenImageIO is not suitable: version 2.4 multiplies samples by the scale's magnitude, which would
// change a warp, and it cannot write such files.
namespace ergodome {

//! Three floats per sample, rows from top to bottom. NaN marks an unknown sample.
struct FloatMap {
  int width = 0;
  int height = 0;
  std::vector<float> samples;  //!< 3 * width * height
};

//! The first row of a file. The format defines the bottom row, MPCDI's text the top row; programs
//! write both.
enum class RowOrder { bottom_up, top_down };

//! Returns the number of samples whose first two components are finite.
std::size_t known_samples(const FloatMap& map);

//! Reads a map. Throws Error for another type of map ("Pf" has one component), sizes below 2 x 2 or
//! beyond the limits of warp_mesh.h, scales that are zero or not finite, maps in which every sample
//! is unknown, and a number of bytes that differs from the size in the header. Allocates nothing
//! before these checks.
FloatMap parse_float_map(std::span<const std::byte> bytes, const std::string& name, RowOrder order);

//! Reads a map from a file.
FloatMap read_float_map(const std::filesystem::path& path, RowOrder order);

//! Returns a map as the bytes of a little-endian file.
std::string to_float_map_file(const FloatMap& map, RowOrder order);

}  // namespace ergodome
