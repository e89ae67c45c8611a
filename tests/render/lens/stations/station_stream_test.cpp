#include "render/lens/stations/station_stream.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <fstream>
#include <thread>

#include "content/trajectory/trajectory_journal.h"
#include "render/lens/grid/grid_builder.h"
#include "tests/support/baked_show.h"
#include "tests/support/folder_test.h"
#include "tests/support/sanitized.h"

namespace ergodome {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double patience_s = 10.0;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

class StationStreaming : public test::FolderTest {
 protected:
  //! Writes a trajectory file with stations at intervals of a tenth of a second. Each is closer to
  //! the hole than the one before; all contain the same small grid.
  [[nodiscard]] TrajectoryReader make_file(int stations) {
    GridSettings settings;
    settings.pixel = 0.05;
    settings.observer = aberration_to_rain(Spacetime{0.9}, 9.0, 1.2, ObserverMotion::zamo, {});
    LensStation station = build_lens_station(Spacetime{0.9}, 9.0, 1.2, settings);
    TrajectoryJournal journal(file().string() + ".part", {"1", "", Spacetime{0.9}, 0.05, 0.1, false});
    std::vector<double> times_s;
    for (int i = 0; i < stations; ++i) {
      station.r = 9.0 - 1e-4 * i;
      times_s.push_back(0.1 * i);
      journal.add(times_s.back(), station);
    }
    journal.seal(file(), times_s);
    station_bytes_ = StationBuffers(Backend::cpu, station).bytes();
    return TrajectoryReader(file());
  }

  void damage(const TrajectoryReader& reader, std::size_t station) const {
    test::damage_station(file(), reader.stations()[station]);
  }

  //! Returns a callback that keeps the last message of the stream in message_.
  [[nodiscard]] StationStream::Report report() {
    return [this](const std::string& message) {
      ++said_;
      const std::lock_guard lock(mutex_);
      message_ = message;
    };
  }

  [[nodiscard]] std::filesystem::path file() const { return folder_ / "t.trajectory"; }

  std::size_t station_bytes_ = 0;
  std::atomic<int> said_ = 0;
  std::mutex mutex_;
  std::string message_;
};

//! Plays a part of the show: the time advances by `step_s` per frame. Returns the number of frames
//! that had to wait for a station.
long play(StationStream& stream, double from_s, double to_s, double step_s) {
  stream.at(from_s, patience_s);
  const long before = stream.statistics().waits;
  const int frames = static_cast<int>(std::abs(to_s - from_s) / std::abs(step_s));
  for (int i = 0; i <= frames; ++i) {
    const double time_s = from_s + step_s * i;
    const auto pair = stream.at(time_s, patience_s);
    EXPECT_TRUE(pair && std::abs(pair->first->station().r - (9.0 - 1e-3 * time_s)) <= 1.01e-4) << time_s;
    // A pause of a fifth of a frame's time at 60 Hz; longer under sanitizers, which slow down
    // reading.
    std::this_thread::sleep_for(std::chrono::milliseconds(test::sanitized ? 8 : 3));
  }
  return stream.statistics().waits - before;
}

TEST_F(StationStreaming, SteadyPlayNeverWaitsForwardsBackwardsOrFast) {
  StationStream stream(Backend::cpu, make_file(300), StationStream::default_memory_bytes, report());
  EXPECT_EQ(play(stream, 0.0, 6.0, 1.0 / 60.0), 0);
  EXPECT_EQ(play(stream, 20.0, 15.0, -1.0 / 60.0), 0);
  EXPECT_EQ(play(stream, 0.0, 29.0, 0.2), 0);
  EXPECT_EQ(stream.statistics().missed, 0);
}

TEST_F(StationStreaming, MemoryStaysWithinItsBoundHoweverLongTheTrajectory) {
  TrajectoryReader reader = make_file(400);
  const std::size_t bound = 20 * station_bytes_;
  StationStream stream(Backend::cpu, std::move(reader), bound, report());
  EXPECT_EQ(play(stream, 0.0, 39.0, 0.05), 0);
  EXPECT_LE(stream.statistics().max_bytes_held, bound);
  EXPECT_GE(stream.statistics().read, 390);
}

TEST_F(StationStreaming, ABoundBelowTwoStationsStillPlays) {
  StationStream stream(Backend::cpu, make_file(5), 1, report());
  for (const double time_s : {0.05, 0.15, 0.35, 0.4}) {
    EXPECT_TRUE(stream.at(time_s, patience_s).has_value());
  }
  EXPECT_LE(stream.statistics().max_bytes_held, 2 * station_bytes_);
}

TEST_F(StationStreaming, SeekingIsAnsweredWithinFiftyMilliseconds) {
  StationStream stream(Backend::cpu, make_file(300), 20 * station_bytes_, report());
  for (const double time_s : {25.0, 3.0, 17.0, 29.9, 0.0}) {
    const auto start = Clock::now();
    EXPECT_TRUE(stream.at(time_s, patience_s).has_value());
    EXPECT_LT(seconds_since(start), test::sanitized ? 0.5 : 0.05) << time_s;
  }
}

TEST_F(StationStreaming, ImpatienceIsKept) {
  StationStream stream(Backend::cpu, make_file(300), 4 * station_bytes_, report());
  int given_up = 0;
  for (int i = 0; i < 200; ++i) {
    given_up += stream.at((7 * i) % 30, 0.0).has_value() ? 0 : 1;
  }
  EXPECT_GT(given_up, 0);
  EXPECT_EQ(stream.statistics().missed, given_up);
}

TEST_F(StationStreaming, ABadStationIsBlendedAcrossAndToldOnce) {
  TrajectoryReader reader = make_file(10);
  damage(reader, 3);
  StationStream stream(Backend::cpu, std::move(reader), StationStream::default_memory_bytes, report());
  for (int pass = 0; pass < 3; ++pass) {
    for (const double time_s : {0.25, 0.32, 0.38}) {
      const auto pair = stream.at(time_s, patience_s);
      ASSERT_TRUE(pair && pair->second);
      EXPECT_DOUBLE_EQ(pair->first->station().r, 9.0 - 2e-4);
      EXPECT_DOUBLE_EQ(pair->second->station().r, 9.0 - 4e-4);
      EXPECT_TRUE(pair->skips);
    }
  }
  EXPECT_FALSE(stream.at(0.15, patience_s)->skips);
  EXPECT_EQ(said_, 1);
  EXPECT_THAT(message_, testing::HasSubstr("station 4"));
  EXPECT_EQ(stream.statistics().bad, 1);
}

TEST_F(StationStreaming, AtAStationsOwnTimeABadNeighbourIsNotMissed) {
  TrajectoryReader reader = make_file(5);
  damage(reader, 3);
  const double time_s = reader.stations()[2].time_s;
  StationStream stream(Backend::cpu, std::move(reader), StationStream::default_memory_bytes, report());
  stream.at(0.31, patience_s);
  EXPECT_TRUE(stream.at(0.25, patience_s)->skips);
  const auto there = stream.at(time_s, patience_s);
  ASSERT_TRUE(there);
  EXPECT_FALSE(there->skips);
  EXPECT_DOUBLE_EQ(there->first->station().r, 9.0 - 2e-4);
}

TEST_F(StationStreaming, BadStationsAtTheEndsLeaveTheNearestGoodOne) {
  TrajectoryReader reader = make_file(4);
  damage(reader, 0);
  damage(reader, 3);
  StationStream stream(Backend::cpu, std::move(reader), StationStream::default_memory_bytes, report());
  stream.at(0.15, patience_s);
  const auto begin = stream.at(0.05, patience_s);
  const auto end = stream.at(0.25, patience_s);
  ASSERT_TRUE(begin && end);
  EXPECT_DOUBLE_EQ(begin->first->station().r, 9.0 - 1e-4);
  EXPECT_DOUBLE_EQ(end->first->station().r, 9.0 - 2e-4);
  EXPECT_TRUE(begin->skips && end->skips);
}

TEST_F(StationStreaming, WithoutAnyGoodStationItSaysSoAtOnce) {
  TrajectoryReader reader = make_file(2);
  damage(reader, 0);
  damage(reader, 1);
  StationStream stream(Backend::cpu, std::move(reader), StationStream::default_memory_bytes, report());
  const auto start = Clock::now();
  EXPECT_FALSE(stream.at(0.05, patience_s).has_value());
  EXPECT_FALSE(stream.at(0.05, patience_s).has_value());
  EXPECT_LT(seconds_since(start), 5.0);
  EXPECT_EQ(said_, 2);
}

}  // namespace
}  // namespace ergodome
