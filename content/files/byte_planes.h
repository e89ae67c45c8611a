#pragma once

#include <bit>

#include "content/trajectory/bytes.h"

namespace ergodome {

// Storage of four-byte numbers as byte planes, which compress better.
inline constexpr std::size_t bytes_a_number = 4;

//! Writes every `stride`-th number, beginning at `first`, as four planes of their bytes. The high
//! bytes are similar and compress well.
template <class T>
void write_planes(ByteWriter& to, const std::vector<T>& numbers, std::size_t first, std::size_t stride) {
  static_assert(sizeof(T) == bytes_a_number);
  const std::size_t count = numbers.size() / stride;
  Bytes planes(bytes_a_number * count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto bits = std::bit_cast<std::uint32_t>(numbers[first + i * stride]);
    for (std::size_t plane = 0; plane < bytes_a_number; ++plane) {
      planes[plane * count + i] = static_cast<std::byte>(bits >> (8 * plane));
    }
  }
  to.append(planes);
}

//! Reads every `stride`-th number, beginning at `first`, from such planes.
template <class T>
void read_planes(ByteReader& from, std::vector<T>& numbers, std::size_t first, std::size_t stride) {
  static_assert(sizeof(T) == bytes_a_number);
  const std::size_t count = numbers.size() / stride;
  const std::span<const std::byte> planes = from.take(bytes_a_number * count);
  for (std::size_t i = 0; i < count; ++i) {
    std::uint32_t bits = 0;
    for (std::size_t plane = 0; plane < bytes_a_number; ++plane) {
      bits |= std::to_integer<std::uint32_t>(planes[plane * count + i]) << (8 * plane);
    }
    numbers[first + i * stride] = std::bit_cast<T>(bits);
  }
}

}  // namespace ergodome
