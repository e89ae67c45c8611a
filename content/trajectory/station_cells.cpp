#include "content/trajectory/station_cells.h"

#include <zstd.h>

#include <algorithm>
#include <cmath>

#include "content/files/bytes.h"
#include "kernels/spacetime/kerr/kerr.h"

namespace ergodome {

namespace {

constexpr int compression_level = 9;
constexpr std::uint32_t max_root_cells = 1 << 16;

void write_vector(ByteWriter& to, const Vector3<float>& v) {
  to.number(v.x);
  to.number(v.y);
  to.number(v.z);
}

Vector3<float> read_vector(ByteReader& from) {
  const auto x = from.number<float>();
  const auto y = from.number<float>();
  return {x, y, from.number<float>()};
}

bool is_position(const LensStation& s) {
  if (!(std::abs(s.spacetime.spin) <= 1.0)) {
    return false;
  }
  const double deepest = std::min(min_interior_radius(s.spacetime), horizon_radius(s.spacetime));
  return s.r > deepest && s.r < 1e9 && s.theta >= 0.0 && s.theta <= 3.1416;
}

//! Returns true if the chart's axes are orthonormal (right-handed or left-handed) and the shadow's
//! edge is an angle at every γ.
bool is_chart(const LensStation& s) {
  const auto near = [](float value, float wanted) { return std::abs(value - wanted) < 1e-3F; };
  const bool orthonormal = near(dot(s.centre, s.centre), 1.0F) && near(dot(s.first, s.first), 1.0F) &&
                           near(dot(s.second, s.second), 1.0F) && near(dot(s.centre, s.first), 0.0F) &&
                           near(dot(s.centre, s.second), 0.0F) && near(dot(s.first, s.second), 0.0F);
  const bool angles = std::ranges::all_of(s.edge, [](float angle) { return angle > 0.0F && angle < 3.1416F; });
  return orthonormal && angles && s.range > 0.0F && s.range < 100.0F;
}

//! Returns true if children follow their parents, at most `deepest_cell` below a root, and all
//! referenced leaves and nodes exist.
bool is_tree(const LensStation& s, std::size_t nodes) {
  const std::size_t roots = static_cast<std::size_t>(s.columns) * static_cast<std::size_t>(s.rows);
  if (s.tree.size() < roots) {
    return false;
  }
  std::vector<int> depth(s.tree.size(), 0);
  for (std::size_t i = 0; i < s.tree.size(); ++i) {
    const int entry = s.tree[i];
    if (entry < 0) {
      if (static_cast<std::size_t>((-1 - entry) >> 1) >= s.leaf_count()) {
        return false;
      }
      continue;
    }
    const auto child = static_cast<std::size_t>(entry >> 1);
    if (child <= i || child < roots || child + 1 >= s.tree.size() || depth[i] == deepest_cell) {
      return false;
    }
    // A depth that is already set means that the cell has two parents.
    if (depth[child] != 0 || depth[child + 1] != 0) {
      return false;
    }
    depth[child] = depth[child + 1] = depth[i] + 1;
  }
  return std::ranges::all_of(s.leaves, [&](int node) { return node >= 0 && static_cast<std::size_t>(node) < nodes; });
}

}  // namespace

bool all_finite(const std::vector<float>& numbers) {
  return std::ranges::all_of(numbers, [](float x) { return std::isfinite(x); });
}

void require_whole(bool good, const char* what, const std::string& location) {
  if (!good) {
    throw Error(location, std::string("is damaged (") + what + ")", "bake it again");
  }
}

PackedBytes pack_bytes(std::span<const std::byte> raw) {
  Bytes small(ZSTD_compressBound(raw.size()));
  const std::size_t size = ZSTD_compress(small.data(), small.size(), raw.data(), raw.size(), compression_level);
  if (ZSTD_isError(size) != 0) {
    throw Error("station", std::string("cannot be compressed: ") + ZSTD_getErrorName(size));
  }
  small.resize(size);
  return {std::move(small), raw.size()};
}

Bytes unpack_bytes(std::span<const std::byte> packed, std::uint64_t unpacked_bytes, const std::string& location) {
  require_whole(ZSTD_getFrameContentSize(packed.data(), packed.size()) == unpacked_bytes, "compressed size", location);
  Bytes raw(unpacked_bytes);
  const std::size_t size = ZSTD_decompress(raw.data(), raw.size(), packed.data(), packed.size());
  require_whole(ZSTD_isError(size) == 0 && size == raw.size(), "cannot be decompressed", location);
  return raw;
}

void write_cells(ByteWriter& to, const LensStation& station, std::uint32_t flags, std::size_t nodes) {
  to.number(station.spacetime.spin);
  to.number(station.r);
  to.number(station.theta);
  write_vector(to, station.centre);
  write_vector(to, station.first);
  write_vector(to, station.second);
  to.number(station.range);
  to.number(flags | (station.mirrored ? station_is_mirrored : 0U));
  for (const std::size_t size : {static_cast<std::size_t>(station.columns), static_cast<std::size_t>(station.rows),
                                 station.edge.size(), station.tree.size(), station.leaf_count(), nodes}) {
    to.number(static_cast<std::uint32_t>(size));
  }
  write_planes(to, station.edge, 0, 1);
  write_planes(to, station.tree, 0, 1);
  for (std::size_t corner = 0; corner < 4; ++corner) {
    write_planes(to, station.leaves, corner, 4);
  }
  write_planes(to, station.leaf_error_px, 0, 1);
}

StationCells read_cells(ByteReader& from, std::size_t stored_floats, const std::string& location) {
  LensStation station;
  station.spacetime = Spacetime{from.number<double>()};
  station.r = from.number<double>();
  station.theta = from.number<double>();
  station.centre = read_vector(from);
  station.first = read_vector(from);
  station.second = read_vector(from);
  station.range = from.number<float>();
  const auto flags = from.number<std::uint32_t>();
  station.mirrored = (flags & station_is_mirrored) != 0;
  std::uint32_t sizes[6];
  for (std::uint32_t& size : sizes) {
    size = from.number<std::uint32_t>();
  }
  const auto [columns, rows, edge, tree, leaves, nodes] = sizes;
  const std::size_t numbers = from.left() / bytes_a_number;
  require_whole(columns > 0 && rows > 0 && columns <= max_root_cells && rows <= max_root_cells / columns &&
                    edge >= 16 && edge <= numbers && tree <= numbers && leaves <= numbers / 5 &&
                    nodes <= numbers / stored_floats,
                "impossible size", location);
  station.columns = static_cast<int>(columns);
  station.rows = static_cast<int>(rows);
  station.edge.resize(edge);
  station.tree.resize(tree);
  station.leaves.resize(std::size_t{4} * leaves);
  station.leaf_error_px.resize(leaves);
  read_planes(from, station.edge, 0, 1);
  read_planes(from, station.tree, 0, 1);
  for (std::size_t corner = 0; corner < 4; ++corner) {
    read_planes(from, station.leaves, corner, 4);
  }
  read_planes(from, station.leaf_error_px, 0, 1);
  require_whole(is_position(station), "position", location);
  require_whole(is_chart(station), "chart", location);
  require_whole(is_tree(station, nodes), "cells", location);
  return {std::move(station), flags, nodes};
}

}  // namespace ergodome
