#include "calibration/warps/pfm.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "calibration/warps/text_lines.h"
#include "calibration/warps/warp_mesh.h"
#include "content/files/whole_file.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

static_assert(std::endian::native == std::endian::little, "floats are stored as a little-endian machine has them");

constexpr std::size_t max_header_bytes = 256;
constexpr std::size_t sample_bytes = 3 * sizeof(float);
constexpr std::size_t max_pfm_bytes = max_header_bytes + max_mesh_nodes * sample_bytes;

struct Header {
  int width;
  int height;
  bool little_endian_first;
  std::size_t bytes;  //!< size of the header, including the line end
};

Header parse_header(std::string_view text, const std::string& name) {
  if (text.starts_with("Pf")) {
    throw Error(name, "is a float map with one component", "export it with three (\"PF\"): x, y and error, or x, y, z");
  }
  if (!text.starts_with("PF")) {
    throw Error(name, "is not a portable float map", "name a file that begins with \"PF\"");
  }
  std::string_view rest = text.substr(2, max_header_bytes);
  const auto width = whole_number_of(take_word(rest));
  const auto height = whole_number_of(take_word(rest));
  const auto scale = number_of(take_word(rest));
  if (!width || !height || !scale || rest.empty()) {
    throw Error(name, "has a header without width, height and scale",
                "begin the file with \"PF\", width, height and -1.0");
  }
  if (!std::isfinite(*scale) || *scale == 0.0) {
    throw Error(name, "has a scale that does not give the byte order", "write -1.0 for little-endian samples");
  }
  check_mesh_size(*width, *height, name);
  const std::size_t ending = rest.starts_with("\r\n") ? 2 : 1;
  return {static_cast<int>(*width), static_cast<int>(*height), *scale < 0.0,
          static_cast<std::size_t>(rest.data() - text.data()) + ending};
}

float swapped(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  return std::bit_cast<float>(__builtin_bswap32(bits));
}

}  // namespace

std::size_t known_samples(const FloatMap& map) {
  std::size_t known = 0;
  for (std::size_t i = 0; i + 2 < map.samples.size(); i += 3) {
    known += std::isfinite(map.samples[i]) && std::isfinite(map.samples[i + 1]) ? 1 : 0;
  }
  return known;
}

FloatMap parse_float_map(std::span<const std::byte> bytes, const std::string& name, RowOrder order) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const Header header = parse_header(text, name);
  const std::size_t row_floats = 3 * static_cast<std::size_t>(header.width);
  const std::size_t wanted = row_floats * sizeof(float) * static_cast<std::size_t>(header.height);
  const std::size_t found = bytes.size() - std::min(header.bytes, bytes.size());
  if (found != wanted) {
    throw Error(
        name,
        fmt::format("has {} bytes of samples, but {} x {} samples need {}", found, header.width, header.height, wanted),
        "the file is truncated or damaged; export it again");
  }
  FloatMap map{header.width, header.height, std::vector<float>(wanted / sizeof(float))};
  for (int row = 0; row < map.height; ++row) {
    const int to = order == RowOrder::top_down ? row : map.height - 1 - row;
    std::memcpy(map.samples.data() + static_cast<std::size_t>(to) * row_floats,
                bytes.data() + header.bytes + static_cast<std::size_t>(row) * row_floats * sizeof(float),
                row_floats * sizeof(float));
  }
  if (!header.little_endian_first) {
    std::transform(map.samples.begin(), map.samples.end(), map.samples.begin(), swapped);
  }
  if (known_samples(map) == 0) {
    throw Error(name, "contains no sample with a finite position", "export it again");
  }
  return map;
}

FloatMap read_float_map(const std::filesystem::path& path, RowOrder order) {
  const std::string bytes = read_whole_file(path, max_pfm_bytes, "name a portable float map (.pfm)");
  return parse_float_map(std::as_bytes(std::span(bytes)), path.string(), order);
}

std::string to_float_map_file(const FloatMap& map, RowOrder order) {
  std::string bytes = fmt::format("PF\n{} {}\n-1.0\n", map.width, map.height);
  const std::size_t row_floats = 3 * static_cast<std::size_t>(map.width);
  for (int row = 0; row < map.height; ++row) {
    const int from = order == RowOrder::top_down ? row : map.height - 1 - row;
    const float* const samples = map.samples.data() + static_cast<std::size_t>(from) * row_floats;
    bytes.append(reinterpret_cast<const char*>(samples), row_floats * sizeof(float));
  }
  return bytes;
}

}  // namespace ergodome
