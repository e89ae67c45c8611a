#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

// Builds files directly from their specifications, without the libraries that the readers use.
namespace ergodome::test {

//! Computes the CRC-32 that ZIP (APPNOTE 4.4.7) and PNG (annex D) define: polynomial edb88320,
//! reflected.
inline std::uint32_t crc32(const std::string& bytes) {
  std::uint32_t crc = 0xffffffffU;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) {
      crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xedb88320U : 0U);
    }
  }
  return ~crc;
}

inline std::string little(std::uint32_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) {
    text += static_cast<char>(value >> (8U * static_cast<unsigned>(i)));
  }
  return text;
}

inline std::string big(std::uint32_t value, int bytes) {
  const std::string text = little(value, bytes);
  return {text.rbegin(), text.rend()};
}

//! A member of a zip archive, stored without compression unless `method` says otherwise. The size
//! and checksum in its header may be wrong.
struct ZipMember {
  std::string name;
  std::string bytes;
  std::uint32_t stated_size;
  std::uint32_t stated_crc;
  std::uint16_t flags = 0;
  std::uint16_t method = 0;

  ZipMember(std::string called, std::string content)
      : name(std::move(called)),
        bytes(std::move(content)),
        stated_size(static_cast<std::uint32_t>(bytes.size())),
        stated_crc(crc32(bytes)) {}
};

//! Builds a zip archive (PKWARE APPNOTE 4.3): local headers, each with its data; then the central
//! directory and its end record.
inline std::string zip_by_hand(const std::vector<ZipMember>& members) {
  std::string archive;
  std::string directory;
  for (const ZipMember& member : members) {
    const std::string common =
        little(20, 2) + little(member.flags, 2) + little(member.method, 2) + little(0, 4) +
        little(member.stated_crc, 4) + little(static_cast<std::uint32_t>(member.bytes.size()), 4) +
        little(member.stated_size, 4) + little(static_cast<std::uint32_t>(member.name.size()), 2) + little(0, 2);
    const auto offset = static_cast<std::uint32_t>(archive.size());
    archive += "PK\x03\x04" + common + member.name + member.bytes;
    directory += "PK\x01\x02" + little(20, 2) + common + little(0, 2) + little(0, 2) + little(0, 2) + little(0, 4) +
                 little(offset, 4) + member.name;
  }
  const auto count = static_cast<std::uint32_t>(members.size());
  const auto start = static_cast<std::uint32_t>(archive.size());
  return archive + directory + "PK\x05\x06" + little(0, 4) + little(count, 2) + little(count, 2) +
         little(static_cast<std::uint32_t>(directory.size()), 4) + little(start, 4) + little(0, 2);
}

inline std::string png_chunk(const std::string& type, const std::string& data) {
  return big(static_cast<std::uint32_t>(data.size()), 4) + type + data + big(crc32(type + data), 4);
}

//! Builds a PNG in gray (1 channel) or color (3 channels) with 8 or 16 bits. Its rows are not
//! filtered, and are stored in a single uncompressed deflate block.
inline std::string png_by_hand(std::uint32_t width, std::uint32_t height, int channels, int bits,
                               const std::vector<std::uint32_t>& samples) {
  std::string rows;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (i % (width * static_cast<std::size_t>(channels)) == 0) {
      rows += '\0';
    }
    rows += big(samples[i], bits / 8);
  }
  std::uint32_t a = 1;
  std::uint32_t b = 0;
  for (const char byte : rows) {
    a = (a + static_cast<unsigned char>(byte)) % 65521U;
    b = (b + a) % 65521U;
  }
  const auto size = static_cast<std::uint32_t>(rows.size());
  const std::string data = "\x78\x01\x01" + little(size, 2) + little(~size, 2) + rows + big((b << 16U) | a, 4);
  const std::string header =
      big(width, 4) + big(height, 4) + static_cast<char>(bits) + (channels == 1 ? '\0' : '\2') + std::string(3, '\0');
  return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header) + png_chunk("IDAT", data) + png_chunk("IEND", "");
}

//! Builds a portable float map with the least significant byte first. Rows are in the order of
//! `samples`.
inline std::string pfm_by_hand(int width, int height, const std::vector<float>& samples) {
  std::string bytes = "PF\n" + std::to_string(width) + " " + std::to_string(height) + "\n-1.000000\n";
  for (const float sample : samples) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &sample, sizeof(bits));
    bytes += little(bits, 4);
  }
  return bytes;
}

}  // namespace ergodome::test
