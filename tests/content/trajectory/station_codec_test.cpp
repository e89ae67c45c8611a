#include "content/trajectory/station_codec.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/content/trajectory/small_stations.h"
#include "tests/support/errors.h"

namespace ergodome {
namespace {

using test::error_of;
using test::expect_same;
using test::small_disk;
using test::small_station;
using testing::HasSubstr;

LensStation through_the_codec(const LensStation& station) {
  const PackedBytes packed = pack_station(station);
  return unpack_station(packed.bytes, packed.unpacked_bytes, "test: station 1");
}

TEST(StationCodec, KeepsEveryBitOfAStation) {
  LensStation station = small_station(6.0);
  expect_same(through_the_codec(station), station);
  station.mirrored = true;
  station.nodes_along_r = station.nodes;
  station.nodes_along_theta = small_station(6.0, 2).nodes;
  expect_same(through_the_codec(station), station);
}

//! A change that makes the content of a station invalid, and a part of the resulting error message.
struct Damage {
  const char* what;
  void (*apply)(LensStation& station);
};

class StationCodecRefuses : public testing::TestWithParam<Damage> {};

TEST_P(StationCodecRefuses, WhatKernelsCouldNotReadSafely) {
  LensStation station = small_station(6.0);
  GetParam().apply(station);
  const PackedBytes packed = pack_station(station);
  const std::string message = error_of([&] { unpack_station(packed.bytes, packed.unpacked_bytes, "f: station 7"); });
  EXPECT_THAT(message, HasSubstr("f: station 7"));
  EXPECT_THAT(message, HasSubstr(GetParam().what));
}

INSTANTIATE_TEST_SUITE_P(Damage, StationCodecRefuses,
                         testing::Values(Damage{"(position)", [](LensStation& s) { s.r = 0.5; }},
                                         Damage{"(position)", [](LensStation& s) { s.spacetime = Spacetime{NAN}; }},
                                         Damage{"(position)", [](LensStation& s) { s.theta = -1.0; }},
                                         Damage{"(chart)", [](LensStation& s) { s.first = s.second; }},
                                         Damage{"(chart)", [](LensStation& s) { s.edge[5] = NAN; }},
                                         Damage{"(chart)", [](LensStation& s) { s.range = 0.0F; }},
                                         Damage{"impossible size", [](LensStation& s) { s.columns = 0; }},
                                         Damage{"impossible size", [](LensStation& s) { s.edge.clear(); }},
                                         Damage{"(cells)", [](LensStation& s) { s.tree[0] = 0; }},
                                         Damage{"(cells)", [](LensStation& s) { s.tree[2] = 2 * 2; }},
                                         Damage{"(cells)", [](LensStation& s) { s.tree[0] = 2 * 3; }},
                                         Damage{"(cells)", [](LensStation& s) { s.tree[1] = -1 - 2 * 3; }},
                                         Damage{"(cells)", [](LensStation& s) { s.leaves[4] = 6; }},
                                         Damage{"(cells)", [](LensStation& s) { s.leaves[4] = -1; }},
                                         Damage{"(cells)",
                                                [](LensStation& s) {
                                                  s.tree.assign(2, -1);
                                                  for (int depth = 0; depth <= deepest_cell; ++depth) {
                                                    s.tree[depth == 0 ? 0 : s.tree.size() - 2] =
                                                        2 * static_cast<int>(s.tree.size());
                                                    s.tree.insert(s.tree.end(), 2, -1);
                                                  }
                                                }},
                                         Damage{"(cells)",
                                                [](LensStation& s) {
                                                  // A root cell refers to the same cell as both of
                                                  // its halves.
                                                  s.tree = {2 * 2 + 1, -1, 2 * 4, 2 * 4, -1, -1};
                                                }},
                                         Damage{"a non-finite number", [](LensStation& s) { s.nodes[17] = INFINITY; }}),
                         [](const testing::TestParamInfo<Damage>& each) {
                           return "Case" + std::to_string(each.index);
                         });

DiskStation through_the_codec(const DiskStation& disk) {
  const PackedBytes packed = pack_disk(disk);
  return unpack_disk(packed.bytes, packed.unpacked_bytes, "test: station 1, disk");
}

TEST(DiskCodec, KeepsEveryBitOfLayersWithAPatternAndWithout) {
  for (const bool pattern : {false, true}) {
    DiskStation disk = small_disk(6.0, pattern);
    expect_same(through_the_codec(disk), disk);
    for (int set = 0; set < disk.sets(); ++set) {
      disk.nodes_along_r[set] = small_disk(6.0, pattern, 4).nodes[set];
      disk.nodes_along_theta[set] = small_disk(6.0, pattern, 5).nodes[set];
    }
    expect_same(through_the_codec(disk), disk);
  }
}

//! A change that makes the content of a disk grid invalid, and a part of the resulting error
//! message.
struct DiskDamage {
  const char* what;
  void (*apply)(DiskStation& disk);
};

class DiskCodecRefuses : public testing::TestWithParam<DiskDamage> {};

TEST_P(DiskCodecRefuses, WhatKernelsCouldNotReadSafely) {
  DiskStation disk = small_disk(6.0, true);
  GetParam().apply(disk);
  const PackedBytes packed = pack_disk(disk);
  const std::string message = error_of([&] { unpack_disk(packed.bytes, packed.unpacked_bytes, "f: station 7, disk"); });
  EXPECT_THAT(message, HasSubstr("f: station 7, disk"));
  EXPECT_THAT(message, HasSubstr(GetParam().what));
}

INSTANTIATE_TEST_SUITE_P(
    Damage, DiskCodecRefuses,
    testing::Values(DiskDamage{"(position)", [](DiskStation& d) { d.cells.r = 0.5; }},
                    DiskDamage{"(cells)", [](DiskStation& d) { d.cells.leaves[4] = 6; }},
                    DiskDamage{"disk edges", [](DiskStation& d) { d.outer_r = d.inner_r; }},
                    DiskDamage{"disk edges", [](DiskStation& d) { d.inner_r = NAN; }},
                    DiskDamage{"unexpected size", [](DiskStation& d) { d.orders.push_back(1); }},
                    DiskDamage{"unexpected size", [](DiskStation& d) { d.nodes_along_r[0] = d.nodes[0]; }},
                    DiskDamage{"a non-finite number", [](DiskStation& d) { d.nodes[2][17] = INFINITY; }}),
    [](const testing::TestParamInfo<DiskDamage>& each) { return "Case" + std::to_string(each.index); });

}  // namespace
}  // namespace ergodome
