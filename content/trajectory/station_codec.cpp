#include "content/trajectory/station_codec.h"

#include <utility>

#include "content/files/byte_planes.h"

namespace ergodome {

namespace {

//! Stored components of a node: three of each vector, and the first padding float, which marks a
//! node that sees the sky.
constexpr int stored_components[] = {0, 1, 2, 3, 4, 5, 6, 8, 9, 10, 12, 13, 14};

void write_nodes(ByteWriter& to, const std::vector<float>& nodes) {
  for (const int component : stored_components) {
    write_planes(to, nodes, static_cast<std::size_t>(component), floats_a_node);
  }
}

void read_nodes(ByteReader& from, std::size_t count, std::vector<float>& nodes) {
  nodes.resize(count * floats_a_node);
  for (const int component : stored_components) {
    read_planes(from, nodes, static_cast<std::size_t>(component), floats_a_node);
  }
}

}  // namespace

Bytes station_layout(const LensStation& station) {
  ByteWriter to;
  const bool derivatives = !station.nodes_along_r.empty();
  write_cells(to, station, derivatives ? station_has_derivatives : 0U, station.node_count());
  write_nodes(to, station.nodes);
  if (derivatives) {
    write_nodes(to, station.nodes_along_r);
    write_nodes(to, station.nodes_along_theta);
  }
  return to.take();
}

PackedBytes pack_station(const LensStation& station) { return pack_bytes(station_layout(station)); }

LensStation unpack_station(std::span<const std::byte> packed, std::uint64_t unpacked_bytes, const std::string& place) {
  return parse_station_layout(unpack_bytes(packed, unpacked_bytes, place), place);
}

LensStation parse_station_layout(std::span<const std::byte> raw, const std::string& place) {
  ByteReader from(raw, place);
  auto [station, flags, nodes] = read_cells(from, std::size(stored_components), place);
  read_nodes(from, nodes, station.nodes);
  if ((flags & station_has_derivatives) != 0) {
    require_whole(from.left() >= 2 * nodes * std::size(stored_components) * bytes_a_number, "missing derivatives",
                  place);
    read_nodes(from, nodes, station.nodes_along_r);
    read_nodes(from, nodes, station.nodes_along_theta);
  }
  require_whole(from.left() == 0, "surplus data", place);
  require_whole(all_finite(station.nodes) && all_finite(station.nodes_along_r) && all_finite(station.nodes_along_theta),
                "a non-finite number", place);
  return std::move(station);
}

}  // namespace ergodome
