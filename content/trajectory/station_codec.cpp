#include "content/trajectory/station_codec.h"

#include <algorithm>
#include <utility>

#include "content/files/bytes.h"
#include "content/trajectory/frame.h"

namespace ergodome {

namespace {

//! Indices of the floats of a node that are stored: the three components of each vector, and the
//! first padding float, which marks a node that sees the sky.
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

//! Returns how many components of each node are stored: 1/r of three orders, or with a pattern all
//! four components. Each is stored as its value, its derivatives along γ and s, and its mixed
//! derivative.
std::size_t stored_parts(bool pattern) { return pattern ? 4 : 3; }

std::size_t stored_floats(const DiskStation& station) {
  return static_cast<std::size_t>(station.sets()) * 4 * stored_parts(station.pattern);
}

//! Calls `each(nodes, i)` for every set of nodes and of their derivatives along r and θ, and for
//! the index `i`, within a node, of each float that is stored.
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

StationSummary read_summary(ByteReader& from) {
  StationSummary summary;
  summary.time_s = from.number<double>();
  summary.r = from.number<double>();
  summary.theta = from.number<double>();
  summary.nodes = from.number<std::uint32_t>();
  summary.leaves = from.number<std::uint32_t>();
  return summary;
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

LensStation unpack_station(std::span<const std::byte> packed, std::uint64_t unpacked_bytes,
                           const std::string& location) {
  return parse_station_layout(unpack_bytes(packed, unpacked_bytes, location), location);
}

LensStation parse_station_layout(std::span<const std::byte> raw, const std::string& location) {
  ByteReader from(raw, location);
  auto [station, flags, nodes] = read_cells(from, std::size(stored_components), location);
  read_nodes(from, nodes, station.nodes);
  if ((flags & station_has_derivatives) != 0) {
    require_whole(from.left() >= 2 * nodes * std::size(stored_components) * bytes_a_number, "missing derivatives",
                  location);
    read_nodes(from, nodes, station.nodes_along_r);
    read_nodes(from, nodes, station.nodes_along_theta);
  }
  require_whole(from.left() == 0, "surplus data", location);
  require_whole(all_finite(station.nodes) && all_finite(station.nodes_along_r) && all_finite(station.nodes_along_theta),
                "a non-finite number", location);
  return std::move(station);
}

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

DiskStation unpack_disk(std::span<const std::byte> packed, std::uint64_t unpacked_bytes, const std::string& location) {
  return parse_disk_layout(unpack_bytes(packed, unpacked_bytes, location), location);
}

DiskStation parse_disk_layout(std::span<const std::byte> raw, const std::string& location) {
  ByteReader from(raw, location);
  StationCells cells = read_cells(from, 4 * stored_parts(false), location);
  DiskStation station;
  station.cells = std::move(cells.station);
  station.pattern = (cells.flags & station_has_pattern) != 0;
  station.inner_r = from.number<double>();
  station.outer_r = from.number<double>();
  require_whole(are_edges(station), "disk edges", location);
  const std::span<const std::byte> orders = from.take(station.cells.leaf_count());
  station.orders.resize(orders.size());
  std::ranges::transform(orders, station.orders.begin(),
                         [](std::byte order) { return std::to_integer<unsigned char>(order); });
  const bool derivatives = (cells.flags & station_has_derivatives) != 0;
  require_whole(from.left() == (derivatives ? 3 : 1) * cells.nodes * stored_floats(station) * bytes_a_number,
                "unexpected size", location);
  make_room(station, cells.nodes, derivatives);
  for_each_component(station, [&](std::vector<float>& nodes, std::size_t component) {
    read_planes(from, nodes, component, floats_a_node);
  });
  for (const DiskStation::NodeSets* sets : {&station.nodes, &station.nodes_along_r, &station.nodes_along_theta}) {
    require_whole(std::ranges::all_of(*sets, all_finite), "a non-finite number", location);
  }
  return station;
}

Bytes make_station_frame(std::uint32_t number, double time_s, const LensStation& station) {
  ByteWriter payload;
  payload.number(time_s);
  payload.number(station.r);
  payload.number(station.theta);
  payload.number(static_cast<std::uint32_t>(station.node_count()));
  payload.number(static_cast<std::uint32_t>(station.leaf_count()));
  const PackedBytes packed = pack_station(station);
  payload.append(packed.bytes);
  return make_frame(FrameKind::station, number, payload.bytes(), packed.unpacked_bytes);
}

Bytes make_disk_frame(std::uint32_t number, double time_s, const DiskStation& disk) {
  ByteWriter payload;
  payload.number(time_s);
  const PackedBytes packed = pack_disk(disk);
  payload.append(packed.bytes);
  return make_frame(FrameKind::disk, number, payload.bytes(), packed.unpacked_bytes);
}

Bytes renumbered(std::span<const std::byte> frame, std::uint32_t number, const std::string& location) {
  const FrameHeader header = parse_frame_header(frame, location);
  return make_frame(header.kind, number, checked_payload(frame, header.kind, location), header.unpacked_bytes);
}

StationSummary parse_summary(std::span<const std::byte> frame, const std::string& location) {
  ByteReader from(checked_payload(frame, FrameKind::station, location), location);
  return read_summary(from);
}

LensStation parse_station(std::span<const std::byte> frame, const std::string& location) {
  ByteReader from(checked_payload(frame, FrameKind::station, location), location);
  const StationSummary summary = read_summary(from);
  LensStation station =
      unpack_station(from.take(from.left()), parse_frame_header(frame, location).unpacked_bytes, location);
  if (station.r != summary.r || station.theta != summary.theta) {
    throw Error(location, "is damaged (position)", "bake it again");
  }
  return station;
}

double parse_disk_time(std::span<const std::byte> frame, const std::string& location) {
  return ByteReader(checked_payload(frame, FrameKind::disk, location), location).number<double>();
}

DiskStation parse_disk(std::span<const std::byte> frame, const std::string& location) {
  ByteReader from(checked_payload(frame, FrameKind::disk, location), location);
  from.number<double>();
  return unpack_disk(from.take(from.left()), parse_frame_header(frame, location).unpacked_bytes, location);
}

}  // namespace ergodome
