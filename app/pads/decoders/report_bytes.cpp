#include "app/pads/decoders/report_bytes.h"

#include <array>

namespace ergodome {

namespace {

constexpr std::array<std::uint32_t, 256> table = [] {
  std::array<std::uint32_t, 256> entries{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::uint32_t value = i;
    for (int bit = 0; bit < 8; ++bit) {
      value = (value >> 1U) ^ ((value & 1U) != 0 ? 0xEDB88320U : 0U);
    }
    entries[i] = value;
  }
  return entries;
}();

constexpr std::uint32_t next(std::uint32_t crc, std::uint8_t byte) { return (crc >> 8U) ^ table[(crc ^ byte) & 0xFFU]; }

}  // namespace

std::uint32_t crc32_after(std::uint8_t seed, ReportBytes bytes) {
  std::uint32_t crc = next(0xFFFFFFFFU, seed);
  for (const std::uint8_t byte : bytes) {
    crc = next(crc, byte);
  }
  return ~crc;
}

}  // namespace ergodome
