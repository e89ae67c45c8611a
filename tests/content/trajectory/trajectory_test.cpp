#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>

#include "content/trajectory/frame.h"
#include "content/trajectory/station_codec.h"
#include "content/trajectory/trajectory_journal.h"
#include "content/trajectory/trajectory_reader.h"
#include "tests/content/trajectory/small_stations.h"
#include "tests/support/errors.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

using test::error_of;
using test::expect_same;
using test::small_disk;
using test::small_station;
using testing::HasSubstr;

class Trajectory : public test::FolderTest {
 protected:
  static TrajectoryProvenance provenance() {
    return {"1.2.3", "title = \"Test\"\n", Spacetime{0.9}, 1e-3, 0.25, false};
  }

  [[nodiscard]] std::filesystem::path file() const { return folder_ / "t.trajectory"; }
  [[nodiscard]] std::filesystem::path journal_file() const { return folder_ / "t.trajectory.part"; }

  //! Index of the only station without a disk grid.
  static constexpr int bare = 1;

  //! Writes a finished trajectory file with stations at 0 s, 1 s, and so on. All but one have a
  //! disk grid.
  void make_file(int stations = 5) const {
    TrajectoryJournal journal(journal_file(), provenance());
    std::vector<double> times_s;
    for (int i = 0; i < stations; ++i) {
      journal.add(i, small_station(6.0 + i));
      if (i != bare) {
        journal.add(i, small_disk(6.0 + i));
      }
      times_s.push_back(i);
      if (i > 0) {
        journal.add(Gap{i - 1.0, 1.0 * i, 0.125F, 0.5F});
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
  // A single station can be read without reading the others.
  expect_same(reader.read(3), small_station(9.0));
  EXPECT_EQ(reader.stations()[2].disk_gap_error_px, 0.5F);
  EXPECT_EQ(reader.stations()[bare].disk_bytes, 0U);
  EXPECT_EQ(reader.stations()[3].disk_memory_bytes, disk_layout(small_disk(9.0)).size());
  expect_same(reader.read_disk(3), small_disk(9.0));
}

TEST_F(Trajectory, AskedForADiskThatAStationHasNotSaysSo) {
  make_file();
  const TrajectoryReader reader(file());
  EXPECT_THAT(error_of([&] { (void)reader.read_disk(bare); }),
              HasSubstr("station 2, disk: is damaged (a station that does not match the index"));
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
  EXPECT_THAT(error_of([&] { TrajectoryReader reader(file()); }), HasSubstr("does not have its original size"));
}

TEST_F(Trajectory, ForeignNewerAndUnfinishedFilesAreToldApart) {
  write_text(file(), "title = \"a show\"\n");
  EXPECT_THAT(error_of([&] { TrajectoryReader reader(file()); }), HasSubstr("is not a trajectory"));
  make_file();
  std::string text = text_of(file());
  text[8] = 3;
  write_text(file(), text);
  EXPECT_THAT(error_of([&] { TrajectoryReader reader(file()); }), HasSubstr("version 3"));
  EXPECT_THAT(error_of([&] { TrajectoryReader reader(journal_file()); }), HasSubstr("unfinished bake"));
  EXPECT_THAT(error_of([&] { TrajectoryReader reader(folder_ / "none"); }), HasSubstr("none"));
  EXPECT_THAT(error_of([&] { TrajectoryReader reader(folder_); }), HasSubstr("is not a regular file"));
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
        const double r = 6.0 + static_cast<double>(i);
        const std::string lens = error_of([&] { expect_same(reader.read(i), small_station(r)); });
        const std::string disk = i == bare ? "" : error_of([&] { expect_same(reader.read_disk(i), small_disk(r)); });
        for (const std::string& message : {lens, disk}) {
          EXPECT_TRUE(message.empty() || message.find(station_position(file(), i)) != std::string::npos) << message;
          refused += message.empty() ? 0 : 1;
        }
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
    journal.add(0.0, small_disk(6.0));
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
    if (!journal.has_disk(0.0)) {
      journal.add(0.0, small_disk(6.0));
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
  EXPECT_THAT(error_of([&] { TrajectoryJournal other(file(), provenance()); }), HasSubstr("not written by this bake"));
  const TrajectoryJournal journal(journal_file(), provenance());
  EXPECT_THAT(error_of([&] { TrajectoryJournal other(journal_file(), provenance()); }),
              HasSubstr("in use by another ergodome bake"));
}

TEST_F(Trajectory, JournalOfAnotherBakeIsRefused) {
  { const TrajectoryJournal journal(journal_file(), provenance()); }
  TrajectoryProvenance changed = provenance();
  changed.budget_px = 0.5;
  EXPECT_THAT(error_of([&] { TrajectoryJournal other(journal_file(), changed); }),
              HasSubstr("not written by this bake"));
}

TEST_F(Trajectory, JoinedPartsAreTheSameFile) {
  make_file();
  const std::string whole = text_of(file());
  TrajectoryJournal joined(folder_ / "joined", provenance());
  {
    TrajectoryJournal late(folder_ / "late", provenance());
    for (const double time_s : {4.0, 3.0, 2.0}) {
      late.add(time_s, small_station(6.0 + time_s));
      late.add(time_s, small_disk(6.0 + time_s));
    }
    late.add(Gap{2.0, 3.0, 0.125F, 0.5F});
    late.add(Gap{3.0, 4.0, 0.125F, 0.5F});
    joined.absorb(late);
  }
  for (int i = 0; i < 3; ++i) {
    if (!joined.has_station(i)) {
      joined.add(i, small_station(6.0 + i));
    }
    if (i != bare && !joined.has_disk(i)) {
      joined.add(i, small_disk(6.0 + i));
    }
  }
  joined.add(Gap{0.0, 1.0, 0.125F, 0.5F});
  joined.add(Gap{1.0, 2.0, 0.125F, 0.5F});
  joined.seal(file(), {0.0, 1.0, 2.0, 3.0, 4.0});
  EXPECT_EQ(text_of(file()), whole);
}

}  // namespace
}  // namespace ergodome
