#include "app/playback/sound/sound_bytes.h"

#include <algorithm>
#include <string>
#include <string_view>

namespace ergodome {

namespace {

enum class ByteOrder { little, big };

//! Returns the bytes from a position on, fewer at the end of the file.
std::string bytes_at(std::istream& file, std::uint64_t position, std::size_t count) {
  std::string bytes(count, '\0');
  file.clear();
  file.seekg(static_cast<std::streamoff>(position));
  file.read(bytes.data(), static_cast<std::streamsize>(count));
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
  return bytes;
}

//! Returns four bytes as a number; 0 if they are missing.
std::uint32_t word_at(std::string_view bytes, std::size_t position, ByteOrder order) {
  if (bytes.size() < position + 4) {
    return 0;
  }
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t from = order == ByteOrder::big ? position + i : position + 3 - i;
    value = value << 8U | static_cast<unsigned char>(bytes[from]);
  }
  return value;
}

//! Returns the byte position in the file at which the chunk of samples ends; 0 if there is none, or
//! if its size was unknown when it was written.
std::uint64_t end_of_chunk(std::istream& file, std::string_view samples, ByteOrder order) {
  // Programs that write to a pipe store the largest size, or one slightly below 2 GiB.
  constexpr std::uint32_t unknown = 0x7FFFF000;
  constexpr std::uint64_t max_bytes = std::uint64_t{1} << 50U;
  constexpr int max_chunks = 1000;
  std::uint64_t position = 12;
  std::uint64_t large = 0;  // size in RF64, the format for more than 4 GiB
  for (int i = 0; i < max_chunks; ++i) {
    const std::string head = bytes_at(file, position, 8);
    if (head.size() < 8) {
      return 0;
    }
    const std::uint32_t size = word_at(head, 4, order);
    if (head.starts_with(samples)) {
      return size < unknown ? position + 8 + size : large > 0 && large < max_bytes ? position + 8 + large : 0;
    }
    if (head.starts_with("ds64")) {
      const std::string sizes = bytes_at(file, position + 16, 8);
      large = word_at(sizes, 0, order) | std::uint64_t{word_at(sizes, 4, order)} << 32U;
    }
    // Chunks start at even positions.
    position += 8 + std::uint64_t{size} + size % 2;
  }
  return 0;
}

//! Returns eight bytes as a number.
std::uint64_t long_at(std::string_view bytes, std::size_t position, ByteOrder order) {
  const std::uint64_t first = word_at(bytes, position, order);
  const std::uint64_t second = word_at(bytes, position + 4, order);
  return order == ByteOrder::big ? first << 32U | second : second << 32U | first;
}

//! Returns the byte position at which the samples of an AU file end, from the position and size in
//! its header; 0 if the size is unknown.
std::uint64_t end_of_au(std::istream& file, ByteOrder order) {
  constexpr std::uint32_t unknown = 0xFFFFFFFF;
  const std::string head = bytes_at(file, 0, 12);
  const std::uint32_t size = word_at(head, 8, order);
  return size == unknown ? 0 : std::uint64_t{word_at(head, 4, order)} + size;
}

//! Returns the byte position at which the chunk of samples of a Wave64 file ends; 0 if there is
//! none or its size is unknown. Chunks have 16-byte names, which start with the four bytes of WAV,
//! and sizes that include their headers; they start at multiples of eight.
std::uint64_t end_of_wave64(std::istream& file) {
  constexpr std::uint64_t head_bytes = 24;
  constexpr std::uint64_t max_bytes = std::uint64_t{1} << 50U;
  constexpr int max_chunks = 1000;
  std::uint64_t position = head_bytes + 16;
  for (int i = 0; i < max_chunks; ++i) {
    const std::string head = bytes_at(file, position, head_bytes);
    const std::uint64_t size = head.size() < head_bytes ? 0 : long_at(head, 16, ByteOrder::little);
    if (size < head_bytes || size > max_bytes) {
      return 0;
    }
    if (head.starts_with("data")) {
      return position + size;
    }
    position += (size + 7) / 8 * 8;
  }
  return 0;
}

//! Returns the size of an ID3 tag at the start of a file, stored with seven bits per byte.
std::uint64_t tag_bytes(std::string_view head) {
  if (head.size() < 10 || !head.starts_with("ID3")) {
    return 0;
  }
  std::uint64_t size = 0;
  for (std::size_t i = 6; i < 10; ++i) {
    size = size << 7U | (static_cast<unsigned char>(head[i]) & 0x7FU);
  }
  return size + 10;
}

//! Returns the minimum byte position at which an MP3 stream ends, according to the Xing header in
//! its first frame; 0 without that header.
std::uint64_t end_of_mp3(std::istream& file) {
  const std::uint64_t start = tag_bytes(bytes_at(file, 0, 10));
  const std::string frame = bytes_at(file, start, 64);
  if (frame.size() < 2 || frame[0] != '\xFF' || (static_cast<unsigned char>(frame[1]) & 0xE0U) != 0xE0U) {
    return 0;
  }
  std::size_t header = frame.find("Xing");
  header = header != std::string::npos ? header : frame.find("Info");
  if (header == std::string::npos) {
    return 0;
  }
  constexpr std::uint32_t has_frames = 1;
  constexpr std::uint32_t has_bytes = 2;
  const std::uint32_t flags = word_at(frame, header + 4, ByteOrder::big);
  const std::size_t position = header + 8 + ((flags & has_frames) != 0 ? 4 : 0);
  // Encoders disagree about which frames count, so 1 % is allowed, as in the library.
  const std::uint64_t size = word_at(frame, position, ByteOrder::big);
  return (flags & has_bytes) != 0 ? start + size - size / 100 : 0;
}

}  // namespace

bool is_chained_ogg(std::istream& file) {
  // A page that begins a stream, after pages that do not, starts the next link of a chain.
  constexpr std::size_t head_bytes = 27;
  constexpr unsigned begins_stream = 0x02;
  bool after_begin = false;
  for (std::uint64_t position = 0;;) {
    const std::string page = bytes_at(file, position, head_bytes + 255);
    if (page.size() < head_bytes || !page.starts_with("OggS")) {
      return false;
    }
    const bool begins = (static_cast<unsigned char>(page[5]) & begins_stream) != 0;
    if (begins && after_begin) {
      return true;
    }
    after_begin = after_begin || !begins;
    const std::size_t segments = static_cast<unsigned char>(page[26]);
    position += head_bytes + segments;
    for (std::size_t i = 0; i < segments && head_bytes + i < page.size(); ++i) {
      position += static_cast<unsigned char>(page[head_bytes + i]);
    }
  }
}

std::uint64_t promised_bytes(std::istream& file) {
  const std::string head = bytes_at(file, 0, 12);
  const std::string_view kind = std::string_view(head).substr(std::min<std::size_t>(8, head.size()));
  if ((head.starts_with("RIFF") || head.starts_with("RF64")) && kind == "WAVE") {
    return end_of_chunk(file, "data", ByteOrder::little);
  }
  if (head.starts_with("FORM") && (kind == "AIFF" || kind == "AIFC")) {
    return end_of_chunk(file, "SSND", ByteOrder::big);
  }
  if (head.starts_with(".snd") || head.starts_with("dns.")) {
    return end_of_au(file, head[0] == '.' ? ByteOrder::big : ByteOrder::little);
  }
  if (head.starts_with("riff")) {
    return end_of_wave64(file);
  }
  return end_of_mp3(file);
}

}  // namespace ergodome
