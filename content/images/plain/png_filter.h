#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace ergodome {

//! The rows of a PNG, each with the filter that leaves the smallest sum of absolute differences, as
//! libpng chooses. Source: ISO/IEC 15948, 9 and 12.8.
class PngRows {
 public:
  //! `row_bytes`: bytes of a row of pixels; `pixel_bytes`: bytes of a pixel.
  PngRows(std::size_t row_bytes, std::size_t pixel_bytes);

  //! Writes the filter type and the filtered bytes of the next row.
  void filter(std::span<const std::uint8_t> row, std::uint8_t* to);

 private:
  std::size_t pixel_bytes_;
  //! The row above and the row, each behind a pixel of zeros.
  std::vector<std::uint8_t> above_;
  std::vector<std::uint8_t> row_;
  std::vector<std::uint8_t> filtered_;
};

}  // namespace ergodome
