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

//! Reads what ByteWriter wrote. Throws Error, which names `place`, if the bytes are truncated.
class ByteReader {
 public:
  ByteReader(std::span<const std::byte> bytes, std::string place) : rest_(bytes), place_(std::move(place)) {}

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
      throw Error(place_, "is truncated", "bake it again");
    }
    const std::span<const std::byte> taken = rest_.first(count);
    rest_ = rest_.subspan(count);
    return taken;
  }

  [[nodiscard]] std::size_t left() const { return rest_.size(); }

 private:
  std::span<const std::byte> rest_;
  std::string place_;
};

}  // namespace ergodome
