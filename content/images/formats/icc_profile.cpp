#include "content/images/formats/icc_profile.h"

#include <cstddef>
#include <cstdint>

#include "content/images/formats/jpeg_segments.h"
#include "content/images/formats/png_chunks.h"
#include "content/images/formats/tiff_directory.h"

namespace ergodome {

namespace {

constexpr const char* damaged_profile =
    "its color profile is damaged; save the image without it, or convert it to sRGB";

//! Size of the header, which precedes the tag table [bytes].
constexpr std::size_t header_bytes = 128;

//! Position of the signature "acsp" in the header [bytes].
constexpr std::size_t mark_offset = 36;
constexpr std::string_view profile_mark = "acsp";

//! Returns true if the strings of a multilingual text tag lie within the profile.
bool has_texts_within(std::string_view profile, std::size_t tag) {
  constexpr std::size_t fixed_bytes = 16;
  constexpr std::size_t record_bytes = 12;
  if (profile.size() - tag < fixed_bytes) {
    return false;
  }
  const std::size_t records = big_endian_word(profile.substr(tag + 8));
  if (records > (profile.size() - tag - fixed_bytes) / record_bytes) {
    return false;
  }
  for (std::size_t i = 0; i < records; ++i) {
    const std::string_view record = profile.substr(tag + fixed_bytes + i * record_bytes, record_bytes);
    const std::size_t length = big_endian_word(record.substr(4));
    const std::size_t offset = big_endian_word(record.substr(8));
    if (offset > profile.size() - tag || length > profile.size() - tag - offset) {
      return false;
    }
  }
  return true;
}

//! Returns true if a tag lies within the profile and is as long as its type requires.
bool is_sound_tag(std::string_view profile, std::size_t offset, std::size_t size) {
  constexpr std::size_t type_bytes = 8;
  constexpr std::size_t description_bytes = 12;
  if (offset > profile.size() || size > profile.size() - offset || size < type_bytes) {
    return false;
  }
  const std::string_view type = profile.substr(offset, 4);
  return (type != "desc" || size >= description_bytes) && (type != "mluc" || has_texts_within(profile, offset));
}

//! Checks the profiles that are stored uncompressed anywhere in a file. Bytes that only happen to
//! equal the signature are rarely preceded by a plausible size.
std::string problem_of_plain_profiles(std::string_view bytes) {
  constexpr std::uint32_t largest_profile = 1U << 24U;
  for (std::size_t at = bytes.find(profile_mark); at < bytes.size(); at = bytes.find(profile_mark, at + 1)) {
    const std::string_view rest = at < mark_offset ? std::string_view() : bytes.substr(at - mark_offset);
    const std::uint32_t size = rest.empty() ? 0 : big_endian_word(rest);
    if (size > header_bytes && size <= largest_profile && size <= rest.size()) {
      std::string problem = problem_of_icc_profile(rest.substr(0, size));
      if (!problem.empty()) {
        return problem;
      }
    }
  }
  return "";
}

}  // namespace

std::string problem_of_icc_profile(std::string_view profile) {
  constexpr std::size_t entry_bytes = 12;
  const std::size_t table = header_bytes + 4;
  if (profile.size() < table) {
    return damaged_profile;
  }
  const std::size_t tags = big_endian_word(profile.substr(header_bytes));
  if (tags > (profile.size() - table) / entry_bytes) {
    return damaged_profile;
  }
  for (std::size_t i = 0; i < tags; ++i) {
    const std::string_view entry = profile.substr(table + i * entry_bytes, entry_bytes);
    if (!is_sound_tag(profile, big_endian_word(entry.substr(4)), big_endian_word(entry.substr(8)))) {
      return damaged_profile;
    }
  }
  return "";
}

std::string problem_of_icc_profiles(const ImageBytes& file) {
  const std::string head = file.head(png_signature.size());
  const auto begins_with = [&](std::string_view mark) { return head.starts_with(mark); };
  if (begins_with("#?") || begins_with("\x76\x2F\x31\x01")) {
    return "";  // Radiance and OpenEXR files contain no ICC profile.
  }
  std::string profile;
  if (begins_with(png_signature)) {
    profile = png_icc_profile(file.from_start());
  } else if (begins_with("\xFF\xD8")) {
    profile = jpeg_icc_profile(file.all());
  } else if (begins_with("II") || begins_with("MM")) {
    profile = tiff_icc_profile(file.name(), file.memory());
  } else {
    return problem_of_plain_profiles(file.all());
  }
  return profile.empty() ? "" : problem_of_icc_profile(profile);
}

}  // namespace ergodome
