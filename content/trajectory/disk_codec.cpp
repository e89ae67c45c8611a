#include "content/trajectory/disk_codec.h"

#include <algorithm>
#include <utility>

#include "content/files/byte_planes.h"

namespace ergodome {

namespace {

//! Returns how many components of a node are stored, each as value, derivatives along γ and s, and
//! mixed derivative: 1/r of three orders, or all components with a pattern.
std::size_t stored_parts(bool pattern) { return pattern ? 4 : 3; }

std::size_t stored_floats(const DiskStation& station) {
  return static_cast<std::size_t>(station.sets()) * 4 * stored_parts(station.pattern);
}

//! Calls `each` with every set of nodes and every stored component.
template <class Station, class Each>
void for_each_component(Station& station, const Each& each) {
  for (auto* const sets : {&station.nodes, &station.nodes_along_r, &station.nodes_along_theta}) {
    for (int set = 0; set < station.sets(); ++set) {
      auto& nodes = (*sets)[set];
      for (std::size_t i = 0; i < floats_a_node && !nodes.empty(); ++i) {
        if (i % 4 < stored_parts(station.pattern)) {
          each(nodes, i);
        }
      }
    }
  }
}

bool are_edges(const DiskStation& station) {
  return station.inner_r > 0.0 && station.outer_r > station.inner_r && station.outer_r < 1e9;
}

void make_room(DiskStation& station, std::size_t nodes, bool derivatives) {
  for (int set = 0; set < station.sets(); ++set) {
    station.nodes[set].resize(nodes * floats_a_node);
    if (derivatives) {
      station.nodes_along_r[set].resize(nodes * floats_a_node);
      station.nodes_along_theta[set].resize(nodes * floats_a_node);
    }
  }
}

}  // namespace

Bytes disk_layout(const DiskStation& station) {
  ByteWriter to;
  const std::uint32_t flags =
      (station.has_derivatives() ? station_has_derivatives : 0U) | (station.pattern ? station_has_pattern : 0U);
  write_cells(to, station.cells, flags, station.node_count());
  to.number(station.inner_r);
  to.number(station.outer_r);
  to.append(std::as_bytes(std::span(station.orders)));
  for_each_component(station, [&](const std::vector<float>& nodes, std::size_t component) {
    write_planes(to, nodes, component, floats_a_node);
  });
  return to.take();
}

PackedBytes pack_disk(const DiskStation& station) { return pack_bytes(disk_layout(station)); }

DiskStation unpack_disk(std::span<const std::byte> packed, std::uint64_t unpacked_bytes, const std::string& place) {
  return parse_disk_layout(unpack_bytes(packed, unpacked_bytes, place), place);
}

DiskStation parse_disk_layout(std::span<const std::byte> raw, const std::string& place) {
  ByteReader from(raw, place);
  StationCells cells = read_cells(from, 4 * stored_parts(false), place);
  DiskStation station;
  station.cells = std::move(cells.station);
  station.pattern = (cells.flags & station_has_pattern) != 0;
  station.inner_r = from.number<double>();
  station.outer_r = from.number<double>();
  require_whole(are_edges(station), "disk edges", place);
  const std::span<const std::byte> orders = from.take(station.cells.leaf_count());
  station.orders.resize(orders.size());
  std::ranges::transform(orders, station.orders.begin(),
                         [](std::byte order) { return std::to_integer<unsigned char>(order); });
  const bool derivatives = (cells.flags & station_has_derivatives) != 0;
  require_whole(from.left() == (derivatives ? 3 : 1) * cells.nodes * stored_floats(station) * bytes_a_number,
                "unexpected size", place);
  make_room(station, cells.nodes, derivatives);
  for_each_component(station, [&](std::vector<float>& nodes, std::size_t component) {
    read_planes(from, nodes, component, floats_a_node);
  });
  for (const DiskStation::NodeSets* sets : {&station.nodes, &station.nodes_along_r, &station.nodes_along_theta}) {
    require_whole(std::ranges::all_of(*sets, all_finite), "a non-finite number", place);
  }
  return station;
}

}  // namespace ergodome
