#include "content/images/formats/jpeg_segments.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>

namespace ergodome {

namespace {

constexpr unsigned start_of_scan = 0xDA;
constexpr unsigned end_of_image = 0xD9;
constexpr unsigned app2 = 0xE2;
constexpr unsigned no_marker = 0;

//! A marker and the data of its segment.
struct JpegSegment {
  unsigned marker = no_marker;
  std::string_view data;
};

//! Returns true for markers that no length follows: start, end, restarts, TEM (1), and 0, which
//! follows a data byte of 255.
bool stands_alone(unsigned marker) { return marker <= 0x01 || (marker >= 0xD0 && marker <= 0xD9); }

//! Returns the first segment at or after position `at`, and moves `at` behind it. The marker is
//! `no_marker` if no segment follows.
JpegSegment next_segment(std::string_view bytes, std::size_t& at) {
  const auto byte = [&](std::size_t position) {
    return static_cast<unsigned>(static_cast<unsigned char>(bytes[position]));
  };
  while ((at = bytes.find('\xFF', at)) < bytes.size() && at + 1 < bytes.size()) {
    const unsigned marker = byte(at + 1);
    if (marker == 0xFF) {
      at += 1;
    } else if (stands_alone(marker)) {
      at += 2;
      if (marker > 0x01) {
        return {marker, {}};
      }
    } else if (at + 3 < bytes.size()) {
      const std::size_t begin = at + 4;
      at += 2 + 256 * byte(at + 2) + byte(at + 3);
      return {marker, begin < at && at <= bytes.size() ? bytes.substr(begin, at - begin) : std::string_view()};
    } else {
      break;
    }
  }
  return {};
}

}  // namespace

bool has_jpeg_end(std::string_view bytes) {
  std::size_t at = 0;
  JpegSegment segment;
  do {
    segment = next_segment(bytes, at);
  } while (segment.marker != no_marker && segment.marker != end_of_image);
  return segment.marker == end_of_image;
}

bool is_plain_jpeg(std::string_view bytes) {
  // Start of image, JFIF, quantization tables, baseline frame, Huffman tables, restart interval
  constexpr unsigned plain_markers[] = {0xD8, 0xE0, 0xDB, 0xC0, 0xC4, 0xDD};
  std::size_t at = 0;
  JpegSegment segment;
  do {
    segment = next_segment(bytes, at);
  } while (std::ranges::find(plain_markers, segment.marker) != std::end(plain_markers));
  return segment.marker == start_of_scan;
}

std::string jpeg_icc_profile(std::string_view bytes) {
  constexpr std::string_view name("ICC_PROFILE\0", 12);
  std::map<unsigned, std::string_view> parts;
  unsigned count = 0;
  std::size_t at = 0;
  for (JpegSegment segment = next_segment(bytes, at); segment.marker != no_marker && segment.marker != start_of_scan;
       segment = next_segment(bytes, at)) {
    if (segment.marker == app2 && segment.data.starts_with(name) && segment.data.size() >= name.size() + 2) {
      const std::string_view part = segment.data.substr(name.size());
      parts.emplace(static_cast<unsigned char>(part[0]), part.substr(2));
      count = static_cast<unsigned char>(part[1]);
    }
  }
  std::string profile;
  if (parts.size() == count) {
    for (const auto& [number, part] : parts) {
      profile += part;
    }
  }
  return profile;
}

}  // namespace ergodome
