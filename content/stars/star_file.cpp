#include "content/stars/star_file.h"

#include <fmt/format.h>
#include <xxhash.h>
#include <zstd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "content/files/atomic_file.h"
#include "content/files/bytes.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

constexpr char star_magic[8] = {'E', 'R', 'G', 'O', 'S', 'T', 'A', 'R'};
constexpr std::uint32_t version = 1;
constexpr std::size_t summed_bytes = 32;
constexpr std::size_t header_bytes = 40;
constexpr std::size_t bytes_a_star = 20;
//! Maximum compression ratio that is accepted, so that a false header cannot cause a large
//! allocation.
constexpr std::uint64_t max_packing = 4096;
constexpr std::uint32_t max_file_stars = 100'000'000;
constexpr double units_a_degree = 1e7;
constexpr double units_a_magnitude = 1e3;
constexpr std::int32_t no_colour = std::numeric_limits<std::int32_t>::min();
constexpr int star_compression_level = 19;

std::uint64_t checksum(std::span<const std::byte> bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

//! The columns of a catalog as four-byte numbers.
struct PackedColumns {
  std::vector<std::uint32_t> number;
  std::vector<std::uint32_t> right_ascension;
  std::vector<std::int32_t> declination;
  std::vector<std::int32_t> v_mag;
  std::vector<std::int32_t> b_v;

  explicit PackedColumns(std::size_t count)
      : number(count), right_ascension(count), declination(count), v_mag(count), b_v(count) {}

  template <class Each>
  void each(const Each& visit) {
    visit(number);
    visit(right_ascension);
    visit(declination);
    visit(v_mag);
    visit(b_v);
  }

  void set(std::size_t i, const CatalogueStar& star) {
    number[i] = star.number;
    right_ascension[i] = static_cast<std::uint32_t>(std::llround(star.ra_deg * units_a_degree));
    declination[i] = static_cast<std::int32_t>(std::lround(star.dec_deg * units_a_degree));
    v_mag[i] = static_cast<std::int32_t>(std::lround(static_cast<double>(star.v_mag) * units_a_magnitude));
    // A color that is NaN or does not fit is stored as missing.
    const double colour = static_cast<double>(star.b_v) * units_a_magnitude;
    b_v[i] = std::abs(colour) < 1e9 ? static_cast<std::int32_t>(std::lround(colour)) : no_colour;
  }

  [[nodiscard]] CatalogueStar star(std::size_t i, const std::string& location) const {
    const double ra_deg = right_ascension[i] / units_a_degree;
    const double dec_deg = declination[i] / units_a_degree;
    const double magnitude = v_mag[i] / units_a_magnitude;
    if (ra_deg > 360.0 || std::abs(dec_deg) > 90.0 || std::abs(magnitude) > 60.0 ||
        (i > 0 && v_mag[i - 1] > v_mag[i])) {
      throw Error(location, fmt::format("is damaged (star {})", i + 1),
                  "create it again with ergodome catalogue TABLE --out FILE");
    }
    const float colour =
        b_v[i] == no_colour ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(b_v[i] / units_a_magnitude);
    return {number[i], ra_deg, dec_deg, static_cast<float>(magnitude), colour};
  }
};

Bytes packed(std::span<const std::byte> raw) {
  Bytes bytes(ZSTD_compressBound(raw.size()));
  const std::size_t size = ZSTD_compress(bytes.data(), bytes.size(), raw.data(), raw.size(), star_compression_level);
  if (ZSTD_isError(size) != 0) {
    throw Error("star catalogue", fmt::format("cannot be compressed ({})", ZSTD_getErrorName(size)));
  }
  bytes.resize(size);
  return bytes;
}

Bytes unpacked_stars(std::span<const std::byte> bytes, std::size_t size, const std::string& location) {
  Bytes raw(size);
  if (ZSTD_decompress(raw.data(), raw.size(), bytes.data(), bytes.size()) != size) {
    throw Error(location, "is damaged (compressed part)", "create it again with ergodome catalogue TABLE --out FILE");
  }
  return raw;
}

}  // namespace

bool is_star_file(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  char begin[sizeof star_magic] = {};
  stream.read(begin, sizeof begin);
  return stream && std::equal(std::begin(begin), std::end(begin), std::begin(star_magic));
}

StarCatalogue parse_star_file(std::span<const std::byte> bytes, const std::string& location) {
  if (bytes.size() < header_bytes ||
      !std::ranges::equal(bytes.first(sizeof star_magic), std::as_bytes(std::span(star_magic)))) {
    throw Error(location, "is not a star file of Ergodome", "create one with ergodome catalogue TABLE --out FILE");
  }
  ByteReader header(bytes.first(header_bytes).subspan(sizeof star_magic), location);
  const auto written = header.number<std::uint32_t>();
  const auto count = header.number<std::uint32_t>();
  const auto packed_bytes = header.number<std::uint64_t>();
  const auto packed_sum = header.number<std::uint64_t>();
  if (header.number<std::uint64_t>() != checksum(bytes.first(summed_bytes))) {
    throw Error(location, "is damaged (header)", "create it again with ergodome catalogue TABLE --out FILE");
  }
  if (written > version) {
    throw Error(location, fmt::format("has format version {}, but this program reads version {}", written, version),
                "create it again with ergodome catalogue TABLE --out FILE, or use a newer Ergodome");
  }
  const std::span<const std::byte> body = bytes.subspan(header_bytes);
  if (body.size() != packed_bytes || count > max_file_stars || bytes_a_star * count > max_packing * body.size() ||
      checksum(body) != packed_sum) {
    throw Error(location, "is damaged or truncated", "create it again with ergodome catalogue TABLE --out FILE");
  }
  const Bytes raw = unpacked_stars(body, bytes_a_star * count, location);
  ByteReader from(raw, location);
  PackedColumns columns(count);
  columns.each([&](auto& column) { read_planes(from, column, 0, 1); });
  StarCatalogue catalogue;
  catalogue.name = location;
  catalogue.stars.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    catalogue.stars.push_back(columns.star(i, location));
  }
  return catalogue;
}

StarCatalogue read_star_file(const std::filesystem::path& path) {
  std::error_code problem;
  const std::uintmax_t size = std::filesystem::file_size(path, problem);
  std::ifstream stream(path, std::ios::binary);
  if (problem || !stream || size > bytes_a_star * std::uintmax_t{max_file_stars}) {
    throw Error(path.string(), "cannot be opened", "check the path and its permissions");
  }
  Bytes bytes(size);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (!stream) {
    throw Error(path.string(), "cannot be read", "check the disk");
  }
  return parse_star_file(bytes, path.string());
}

void write_star_file(const StarCatalogue& catalogue, const std::filesystem::path& path) {
  PackedColumns columns(catalogue.stars.size());
  for (std::size_t i = 0; i < catalogue.stars.size(); ++i) {
    columns.set(i, catalogue.stars[i]);
  }
  ByteWriter raw;
  columns.each([&](const auto& column) { write_planes(raw, column, 0, 1); });
  const Bytes body = packed(raw.bytes());
  ByteWriter file;
  file.append(std::as_bytes(std::span(star_magic)));
  file.number(version);
  file.number(static_cast<std::uint32_t>(catalogue.stars.size()));
  file.number(static_cast<std::uint64_t>(body.size()));
  file.number(checksum(body));
  file.number(checksum(file.bytes()));
  file.append(body);
  write_atomically(path, [&](const std::filesystem::path& partial) {
    std::ofstream stream(partial, std::ios::binary);
    stream.write(reinterpret_cast<const char*>(file.bytes().data()), static_cast<std::streamsize>(file.bytes().size()));
    if (!stream.flush()) {
      throw Error(path.string(), "cannot be written", "check the free space on the disk");
    }
  });
}

}  // namespace ergodome
