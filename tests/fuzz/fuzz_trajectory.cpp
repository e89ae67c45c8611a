#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>

#include "content/trajectory/frame.h"
#include "content/trajectory/station_codec.h"
#include "content/trajectory/trajectory_reader.h"
#include "kernels/core/error.h"

namespace {

using ergodome::Bytes;
using Input = std::span<const std::byte>;

//! Reads a lens grid in many directions, which must be possible for any accepted grid.
void read_all_over(const ergodome::LensStation& station) {
  const ergodome::LensGrid grid = ergodome::grid_view(station);
  const float widest = station.mirrored ? 0.5F : 1.0F;
  for (int i = 0; i < 64; ++i) {
    const float gamma_turns = widest * static_cast<float>(i % 8) / 7.0F;
    const float s = static_cast<float>(i / 8) / 7.0F;
    const ergodome::Leaf leaf = ergodome::find_leaf(grid, gamma_turns, s);
    const ergodome::LeafPosition at = ergodome::position_in(leaf, gamma_turns, s);
    ergodome::patch_value(grid.nodes, grid.leaves + 4 * leaf.number, at.u, at.v, leaf.width_turns, leaf.height);
    float alpha = 0.0F;
    float slope = 0.0F;
    ergodome::edge_at(grid.chart.edge, 6.2831853F * gamma_turns, alpha, slope);
  }
  ergodome::leaf_boxes(station);
  ergodome::flagged_leaves(station);
}

//! Reads a disk grid in many directions, which must be possible for any accepted grid.
void read_all_over(const ergodome::DiskStation& disk) {
  const ergodome::DiskGrid grid = ergodome::disk_grid_view(disk);
  for (int i = 0; i < 64; ++i) {
    const float gamma_turns = (disk.cells.mirrored ? 0.5F : 1.0F) * static_cast<float>(i % 8) / 7.0F;
    const float s = static_cast<float>(i / 8) / 7.0F;
    const ergodome::Leaf leaf = ergodome::find_leaf(grid.cells, gamma_turns, s);
    const ergodome::LeafPosition at = ergodome::position_in(leaf, gamma_turns, s);
    for (int set = 0; set < disk.sets() && disk.orders[static_cast<std::size_t>(leaf.number)] != 0; ++set) {
      ergodome::patch_value(grid.nodes[set], grid.cells.leaves + 4 * leaf.number, at.u, at.v, leaf.width_turns,
                            leaf.height);
    }
  }
}

void try_station(Input input) { read_all_over(ergodome::parse_station_layout(input, "fuzz: station 1")); }

void try_parts(Input input) {
  const Bytes whole(input.begin(), input.end());
  const auto attempt = [&](const auto& parse) {
    try {
      parse();
    } catch (const ergodome::Error&) {
    }
  };
  attempt([&] { ergodome::parse_trajectory_header(input, "fuzz"); });
  attempt([&] { ergodome::parse_provenance(input, "fuzz"); });
  attempt([&] { ergodome::parse_gap(input, "fuzz"); });
  attempt([&] { ergodome::parse_index(input, "fuzz"); });
  attempt([&] { ergodome::checked_payload(input, ergodome::FrameKind::station, "fuzz"); });
  attempt([&] { ergodome::unpack_station(input, 4096, "fuzz"); });
  attempt([&] { ergodome::unpack_disk(input, 4096, "fuzz"); });
}

void try_file(Input input) {
  static const int file = ::memfd_create("fuzz", 0);
  if (file < 0 || ::ftruncate(file, 0) != 0 ||
      ::pwrite(file, input.data(), input.size(), 0) != static_cast<ssize_t>(input.size())) {
    std::abort();
  }
  const ergodome::TrajectoryReader reader("/proc/self/fd/" + std::to_string(file));
  for (std::size_t i = 0; i < reader.stations().size(); ++i) {
    read_all_over(reader.read(i));
    if (reader.stations()[i].disk_bytes > 0) {
      read_all_over(reader.read_disk(i));
    }
  }
}

}  // namespace

// The first byte chooses which layer of the file format the input is for, so that the code that
// runs after the verification of checksums is reached, too.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) {
    return 0;
  }
  const Input input = std::as_bytes(std::span(data, size)).subspan(1);
  try {
    switch (data[0] % 4) {
      case 0:
        try_station(input);
        break;
      case 1:
        try_parts(input);
        break;
      case 2:
        try_file(input);
        break;
      default:
        read_all_over(ergodome::parse_disk_layout(input, "fuzz: station 1, disk"));
        break;
    }
  } catch (const ergodome::Error&) {
  }
  return 0;
}
