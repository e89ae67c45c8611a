#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>

#include "content/trajectory/frame.h"
#include "content/trajectory/station_codec.h"
#include "content/trajectory/station_frame.h"
#include "content/trajectory/trajectory_journal.h"
#include "content/trajectory/trajectory_reader.h"
#include "tests/support/errors.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

using test::error_of;
using testing::HasSubstr;

//! A station of two root cells, one of them split, with numbers of every size.
LensStation small_station(double r, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  LensStation s;
  s.spin = 0.9;
  s.r = r;
  s.theta = 1.25;
  s.centre = {-1.0F, 0.0F, 0.0F};
  s.first = {0.0F, 1.0F, 0.0F};
  s.second = {0.0F, 0.0F, 1.0F};
  s.edge.assign(64, 0.3F);
  s.range = 9.5F;
  s.columns = 2;
  s.rows = 1;
  s.tree = {2 * 2 + 1, -1 - (2 * 0 + 1), -1 - 2 * 1, -1 - 2 * 2};
  s.leaves = {0, 1, 2, 3, 1, 4, 3, 5, 0, 1, 4, 5};
  s.leaf_error_px = {0.5F, 0.01F, 1e30F};
  s.nodes.resize(6 * floats_a_node);
  for (std::size_t i = 0; i < s.nodes.size(); ++i) {
    const bool pad = i % 16 == 7 || i % 16 == 11 || i % 16 == 15;
    s.nodes[i] = i % 16 == 3 ? 1.0F : (pad ? 0.0F : normal(random) * std::pow(10.0F, normal(random)));
  }
  return s;
}

void expect_same(const LensStation& a, const LensStation& b) {
  EXPECT_EQ(a.spin, b.spin);
  EXPECT_EQ(a.r, b.r);
  EXPECT_EQ(a.theta, b.theta);
  EXPECT_EQ(a.edge, b.edge);
  EXPECT_EQ(a.range, b.range);
  EXPECT_EQ(a.mirrored, b.mirrored);
  EXPECT_EQ(a.tree, b.tree);
  EXPECT_EQ(a.leaves, b.leaves);
  EXPECT_EQ(a.leaf_error_px, b.leaf_error_px);
  EXPECT_EQ(a.nodes, b.nodes);
  EXPECT_EQ(a.nodes_along_r, b.nodes_along_r);
  EXPECT_EQ(a.nodes_along_theta, b.nodes_along_theta);
}

LensStation through_the_codec(const LensStation& station) {
  const PackedStation packed = pack_station(station);
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

//! Something that a station must not hold, and how the refusal calls it.
struct Damage {
  const char* what;
  void (*apply)(LensStation& station);
};

class StationCodecRefuses : public testing::TestWithParam<Damage> {};

TEST_P(StationCodecRefuses, WhatKernelsCouldNotReadSafely) {
  LensStation station = small_station(6.0);
  GetParam().apply(station);
  const PackedStation packed = pack_station(station);
  const std::string message = error_of([&] { unpack_station(packed.bytes, packed.unpacked_bytes, "f: station 7"); });
  EXPECT_THAT(message, HasSubstr("f: station 7"));
  EXPECT_THAT(message, HasSubstr(GetParam().what));
}

INSTANTIATE_TEST_SUITE_P(Damage, StationCodecRefuses,
                         testing::Values(Damage{"its place", [](LensStation& s) { s.r = 0.5; }},
                                         Damage{"its place", [](LensStation& s) { s.spin = NAN; }},
                                         Damage{"its place", [](LensStation& s) { s.theta = -1.0; }},
                                         Damage{"its chart", [](LensStation& s) { s.first = s.second; }},
                                         Damage{"its chart", [](LensStation& s) { s.edge[5] = NAN; }},
                                         Damage{"its chart", [](LensStation& s) { s.range = 0.0F; }},
                                         Damage{"a size", [](LensStation& s) { s.columns = 0; }},
                                         Damage{"a size", [](LensStation& s) { s.edge.clear(); }},
                                         Damage{"its cells", [](LensStation& s) { s.tree[0] = 0; }},
                                         Damage{"its cells", [](LensStation& s) { s.tree[2] = 2 * 2; }},
                                         Damage{"its cells", [](LensStation& s) { s.tree[0] = 2 * 3; }},
                                         Damage{"its cells", [](LensStation& s) { s.tree[1] = -1 - 2 * 3; }},
                                         Damage{"its cells", [](LensStation& s) { s.leaves[4] = 6; }},
                                         Damage{"its cells", [](LensStation& s) { s.leaves[4] = -1; }},
                                         Damage{"its cells",
                                                [](LensStation& s) {
                                                  s.tree.assign(2, -1);
                                                  for (int depth = 0; depth <= deepest_cell; ++depth) {
                                                    s.tree[depth == 0 ? 0 : s.tree.size() - 2] =
                                                        2 * static_cast<int>(s.tree.size());
                                                    s.tree.insert(s.tree.end(), 2, -1);
                                                  }
                                                }},
                                         Damage{"no number", [](LensStation& s) { s.nodes[17] = INFINITY; }}),
                         [](const testing::TestParamInfo<Damage>& each) {
                           return "Case" + std::to_string(each.index);
                         });

class Trajectory : public test::FolderTest {
 protected:
  static TrajectoryProvenance provenance() { return {"1.2.3", "title = \"Test\"\n", 0.9, 1e-3, 0.25, false}; }

  [[nodiscard]] std::filesystem::path file() const { return folder_ / "t.trajectory"; }
  [[nodiscard]] std::filesystem::path journal_file() const { return folder_ / "t.trajectory.part"; }

  //! A finished file of five stations, at 0 s, 1 s, ...
  void make_file(int stations = 5) const {
    TrajectoryJournal journal(journal_file(), provenance());
    std::vector<double> times_s;
    for (int i = 0; i < stations; ++i) {
      journal.add(i, small_station(6.0 + i));
      times_s.push_back(i);
      if (i > 0) {
        journal.add(Gap{i - 1.0, 1.0 * i, 0.125F});
      }
    }
    journal.seal(file(), times_s);
  }

  static std::string text_of(const std::filesystem::path& path) {
    std::ifstream from(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(from), {}};
  }

  static void write_text(const std::filesystem::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
  }
};

TEST_F(Trajectory, ReadsBackWhatWasBaked) {
  make_file();
  const TrajectoryReader reader(file());
  EXPECT_EQ(reader.provenance(), provenance());
  ASSERT_EQ(reader.stations().size(), 5U);
  EXPECT_EQ(reader.stations()[2].time_s, 2.0);
  EXPECT_EQ(reader.stations()[2].gap_error_px, 0.125F);
  EXPECT_EQ(reader.stations()[4].gap_error_px, -1.0F);
  // One station, without the others.
  expect_same(reader.read(3), small_station(9.0));
}

TEST_F(Trajectory, CutOffAnywhereIsToldAndNeverRead) {
  make_file();
  const std::string whole = text_of(file());
  for (const std::size_t size : {std::size_t{0}, std::size_t{7}, std::size_t{40}, std::size_t{64}, std::size_t{200},
                                 whole.size() / 2, whole.size() - 1}) {
    write_text(file(), whole.substr(0, size));
    EXPECT_THAT(error_of([&] { TrajectoryReader reader(file()); }), HasSubstr("t.trajectory")) << size;
  }
  write_text(file(), whole + "x");
  EXPECT_THAT(error_of([&] { TrajectoryReader reader(file()); }), HasSubstr("cut off or has grown"));
}

TEST_F(Trajectory, ForeignNewerAndUnfinishedFilesAreToldApart) {
  write_text(file(), "title = \"a show\"\n");
  EXPECT_THAT(error_of([&] { TrajectoryReader reader(file()); }), HasSubstr("is not a trajectory"));
  make_file();
  std::string text = text_of(file());
  text[8] = 2;
  write_text(file(), text);
  EXPECT_THAT(error_of([&] { TrajectoryReader reader(file()); }), HasSubstr("version 2"));
  EXPECT_THAT(error_of([&] { TrajectoryReader reader(journal_file()); }), HasSubstr("not finished"));
  EXPECT_THAT(error_of([&] { TrajectoryReader reader(folder_ / "none"); }), HasSubstr("none"));
  EXPECT_THAT(error_of([&] { TrajectoryReader reader(folder_); }), HasSubstr("is no file"));
}

TEST_F(Trajectory, EveryFlippedByteIsDetectedOrHarmless) {
  make_file();
  const std::string whole = text_of(file());
  std::mt19937 random(7);
  for (int flip = 0; flip < 1000; ++flip) {
    std::string damaged = whole;
    const std::size_t at = random() % whole.size();
    damaged[at] = static_cast<char>(damaged[at] ^ static_cast<char>(1U << random() % 8U));
    write_text(file(), damaged);
    int refused = 0;
    const auto read_all = [&] {
      const TrajectoryReader reader(file());
      for (std::size_t i = 0; i < reader.stations().size(); ++i) {
        const std::string message =
            error_of([&] { expect_same(reader.read(i), small_station(6.0 + static_cast<double>(i))); });
        EXPECT_TRUE(message.empty() || message.find(station_place(file(), i)) != std::string::npos) << message;
        refused += message.empty() ? 0 : 1;
      }
    };
    const bool opened = error_of(read_all).empty();
    EXPECT_TRUE(!opened || refused == 1) << "byte " << at << " of " << whole.size();
  }
}

TEST_F(Trajectory, JournalGoesOnAfterItsLastWholeFrame) {
  {
    TrajectoryJournal journal(journal_file(), provenance());
    journal.add(0.0, small_station(6.0));
    journal.add(1.0, small_station(7.0));
    journal.add(Gap{0.0, 1.0, 0.5F});
  }
  const std::string whole = text_of(journal_file());
  for (std::size_t size = 0; size < whole.size(); size += 13) {
    write_text(journal_file(), whole.substr(0, size));
    TrajectoryJournal journal(journal_file(), provenance());
    if (!journal.has_station(0.0)) {
      journal.add(0.0, small_station(6.0));
    }
    if (!journal.has_station(1.0)) {
      journal.add(1.0, small_station(7.0));
    }
    if (journal.find_gap(0.0, 1.0) == nullptr) {
      journal.add(Gap{0.0, 1.0, 0.5F});
    }
    EXPECT_EQ(text_of(journal_file()), whole) << size;
  }
}

TEST_F(Trajectory, JournalIsForOneProcessAndNoFinishedFile) {
  make_file();
  EXPECT_THAT(error_of([&] { TrajectoryJournal other(file(), provenance()); }), HasSubstr("not the journal"));
  const TrajectoryJournal journal(journal_file(), provenance());
  EXPECT_THAT(error_of([&] { TrajectoryJournal other(journal_file(), provenance()); }), HasSubstr("another process"));
}

TEST_F(Trajectory, JournalOfAnotherBakeIsRefused) {
  { const TrajectoryJournal journal(journal_file(), provenance()); }
  TrajectoryProvenance changed = provenance();
  changed.budget_px = 0.5;
  EXPECT_THAT(error_of([&] { TrajectoryJournal other(journal_file(), changed); }),
              HasSubstr("not the journal of this bake"));
}

TEST_F(Trajectory, JoinedPartsAreTheSameFile) {
  make_file();
  const std::string whole = text_of(file());
  TrajectoryJournal joined(folder_ / "joined", provenance());
  {
    TrajectoryJournal late(folder_ / "late", provenance());
    late.add(4.0, small_station(10.0));
    late.add(3.0, small_station(9.0));
    late.add(2.0, small_station(8.0));
    late.add(Gap{2.0, 3.0, 0.125F});
    late.add(Gap{3.0, 4.0, 0.125F});
    joined.absorb(late);
  }
  for (int i = 0; i < 3; ++i) {
    if (!joined.has_station(i)) {
      joined.add(i, small_station(6.0 + i));
    }
  }
  joined.add(Gap{0.0, 1.0, 0.125F});
  joined.add(Gap{1.0, 2.0, 0.125F});
  joined.seal(file(), {0.0, 1.0, 2.0, 3.0, 4.0});
  EXPECT_EQ(text_of(file()), whole);
}

}  // namespace
}  // namespace ergodome
