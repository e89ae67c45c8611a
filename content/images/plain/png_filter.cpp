#include "content/images/plain/png_filter.h"

#include <algorithm>
#include <cstdlib>

namespace ergodome {

namespace {

//! Predicts a byte from its neighbors to the left, above, and to the upper left.
int paeth_predictor(int left, int above, int upper_left) {
  const int to_left = std::abs(above - upper_left);
  const int to_above = std::abs(left - upper_left);
  const int to_upper_left = std::abs(left + above - 2 * upper_left);
  const int of_two = to_above <= to_upper_left ? above : upper_left;
  return to_left <= to_above && to_left <= to_upper_left ? left : of_two;
}

//! Writes a row's differences to predictions, and returns the sum of their absolute values.
template <class Predict>
std::uint32_t write_differences(const std::uint8_t* row, const std::uint8_t* above, std::size_t count,
                                std::size_t pixel_bytes, std::uint8_t* to, const Predict& predict) {
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint8_t* const left = row + i - pixel_bytes;
    const std::uint8_t* const upper_left = above + i - pixel_bytes;
    const auto difference = static_cast<std::uint8_t>(row[i] - predict(*left, above[i], *upper_left));
    to[i] = difference;
    sum += std::min<std::uint32_t>(difference, 256U - difference);
  }
  return sum;
}

}  // namespace

PngRows::PngRows(std::size_t row_bytes, std::size_t pixel_bytes)
    : pixel_bytes_(pixel_bytes), above_(pixel_bytes + row_bytes), row_(pixel_bytes + row_bytes), filtered_(row_bytes) {}

void PngRows::filter(std::span<const std::uint8_t> row, std::uint8_t* to) {
  std::ranges::copy(row, row_.begin() + static_cast<std::ptrdiff_t>(pixel_bytes_));
  std::uint32_t least = UINT32_MAX;
  const auto consider = [&](std::uint8_t type, const auto& predict) {
    const std::uint32_t sum = write_differences(row_.data() + pixel_bytes_, above_.data() + pixel_bytes_, row.size(),
                                                pixel_bytes_, filtered_.data(), predict);
    if (sum < least) {
      least = sum;
      to[0] = type;
      std::ranges::copy(filtered_, to + 1);
    }
  };
  consider(0, [](int /*left*/, int /*above*/, int /*upper_left*/) { return 0; });
  consider(1, [](int left, int /*above*/, int /*upper_left*/) { return left; });
  consider(2, [](int /*left*/, int above, int /*upper_left*/) { return above; });
  consider(3, [](int left, int above, int /*upper_left*/) { return (left + above) / 2; });
  consider(4, paeth_predictor);
  std::swap(above_, row_);
}

}  // namespace ergodome
