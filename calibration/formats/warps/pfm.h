#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

// Portable float maps (http://www.pauldebevec.com/Research/HDR/PFM/, netpbm's pfm(5)) as warps carry them: "PF", width and
// height, a scale whose sign tells the byte order (negative: least significant byte first), then three floats a sample.
//
// OpenImageIO is not asked: release 2.4 multiplies samples by the scale's size, which would move a warp, and it writes no such file.
namespace ergodome {

//! Three floats a sample, rows from top to bottom. NaN says that a sample is unknown.
struct FloatMap {
  int width = 0;
  int height = 0;
  std::vector<float> samples;  //!< 3 * width * height
};

//! Which row a file begins with. The format says the bottom row, MPCDI's text the top one; programs have done both.
enum class RowOrder { bottom_up, top_down };

//! Returns how many samples have a finite position.
std::size_t known_samples(const FloatMap& map);

//! Reads a map. Throws Error for another type of map ("Pf" has one component), sizes below 2 x 2 or beyond warp_mesh.h's
//! limits, scales that are zero or not finite, a map without a known sample, and when there are not exactly as many bytes as
//! the size calls for; nothing is allocated before that.
FloatMap parse_float_map(std::span<const std::byte> bytes, const std::string& name, RowOrder order);

//! The same from a file.
FloatMap read_float_map(const std::filesystem::path& path, RowOrder order);

//! A map as a file's bytes, least significant byte first.
std::string to_float_map_file(const FloatMap& map, RowOrder order);

}  // namespace ergodome
