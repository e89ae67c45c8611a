#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "kernels/core/error.h"

namespace ergodome {

// Serialization of numbers and texts in trajectory and star files.
static_assert(std::endian::native == std::endian::little, "numbers are stored in little-endian order");

using Bytes = std::vector<std::byte>;

//! Appends numbers and texts to a byte buffer, little-endian, without padding.
class ByteWriter {
 public:
  template <class T>
  void number(T value) {
    static_assert(std::is_arithmetic_v<T>);
    append(std::as_bytes(std::span(&value, 1)));
  }

  //! Appends the length as u32, then the text.
  void text(std::string_view value) {
    number(static_cast<std::uint32_t>(value.size()));
    append(std::as_bytes(std::span(value)));
  }

  void append(std::span<const std::byte> raw);

  [[nodiscard]] const Bytes& bytes() const { return bytes_; }
  Bytes take() { return std::move(bytes_); }

 private:
  Bytes bytes_;
};

//! Reads what ByteWriter wrote. Throws Error, which names `location`, if the bytes are truncated.
class ByteReader {
 public:
  ByteReader(std::span<const std::byte> bytes, std::string location) : rest_(bytes), location_(std::move(location)) {}

  template <class T>
  T number() {
    static_assert(std::is_arithmetic_v<T>);
    T value;
    std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
    return value;
  }

  std::string text() {
    const std::span<const std::byte> raw = take(number<std::uint32_t>());
    return {reinterpret_cast<const char*>(raw.data()), raw.size()};
  }

  std::span<const std::byte> take(std::size_t count) {
    if (count > rest_.size()) {
      throw Error(location_, "is truncated", "bake it again");
    }
    const std::span<const std::byte> taken = rest_.first(count);
    rest_ = rest_.subspan(count);
    return taken;
  }

  [[nodiscard]] std::size_t left() const { return rest_.size(); }

 private:
  std::span<const std::byte> rest_;
  std::string location_;
};

// Storage of four-byte numbers as byte planes: first byte 0 of all numbers, then byte 1 of all, and
// so on, which compresses better.
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

//! Reads every `stride`-th number, beginning at `first`, from the four planes that write_planes()
//! wrote. `numbers` must have its size already.
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
