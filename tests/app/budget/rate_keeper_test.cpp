#include "app/budget/rate_keeper.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <utility>

namespace ergodome {
namespace {

//! Returns the frame times of a ladder in which each rung takes 0.7 of the time of the previous
//! rung.
std::vector<double> even_ladder(double first_ms, int rungs) {
  std::vector<double> times_ms;
  times_ms.reserve(static_cast<std::size_t>(rungs));
  for (int i = 0; i < rungs; ++i) {
    times_ms.push_back(first_ms * std::pow(0.7, i));
  }
  return times_ms;
}

//! A simulated machine that plays a show. For each frame number, a test sets the factor by which
//! the machine is slower than predicted. As in the player, the window polls for finished pictures
//! every `poll_ms`. All times are simulated.
class SimulatedShow {
 public:
  //! `foretold_ms`: the predicted times of the ladder, which the keeper receives.
  SimulatedShow(std::vector<double> times_ms, std::vector<double> foretold_ms, std::size_t first)
      : keeper(std::move(foretold_ms), frame_ms, first), ladder_ms(std::move(times_ms)) {}

  RateKeeper keeper;
  RateRecord record{frame_ms};
  std::function<double(long)> slowness = [](long) { return 1.0; };
  double poll_ms = 4.0;
  std::vector<std::size_t> rungs;  //!< chosen rung of the ladder, for each frame

  void play(long frames) {
    double last_ms = -1.0;
    for (long i = 0; i < frames; ++i) {
      while (!pace.is_due(1e-3 * now_ms)) {
        now_ms += poll_ms;
      }
      pace.begin(1e-3 * now_ms);
      const std::size_t rung = keeper.rung();
      rungs.push_back(rung);
      const double work_ms = ladder_ms[rung] * slowness(i);
      now_ms += poll_ms * std::ceil(work_ms / poll_ms);
      if (last_ms >= 0.0) {
        keeper.note(work_ms, now_ms - last_ms);
        record.note(now_ms - last_ms);
      }
      last_ms = now_ms;
    }
  }

  [[nodiscard]] long changes_after(std::size_t frame) const {
    long changes = 0;
    for (std::size_t i = frame + 1; i < rungs.size(); ++i) {
      changes += rungs[i] != rungs[i - 1] ? 1 : 0;
    }
    return changes;
  }

 private:
  static constexpr double frame_ms = 1000.0 / 30.0;

  std::vector<double> ladder_ms;
  FramePace pace{1e-3 * frame_ms};
  double now_ms = 0.0;
};

SimulatedShow show_on(double first_ms, std::size_t first) {
  return {even_ladder(first_ms, 10), even_ladder(first_ms, 10), first};
}

TEST(RateKeeper, StaysWhereFramesAreInTime) {
  SimulatedShow show = show_on(85.0, 4);  // each frame takes 20 of the allowed 33 ms
  show.play(3000);
  EXPECT_EQ(show.keeper.changes(), 0);
  EXPECT_NEAR(show.record.rate_hz(), 30.0, 0.05 * 30.0);
  EXPECT_LT(show.record.late(), 0.01);
}

TEST(RateKeeper, GoesDownToARungThatHoldsTheRate) {
  SimulatedShow show = show_on(85.0, 0);
  show.play(3000);
  EXPECT_EQ(show.keeper.rung(), 4U);
  EXPECT_EQ(show.changes_after(100), 0);
}

TEST(RateKeeper, GoesUpToTheFinestRungThatHoldsTheRate) {
  SimulatedShow show = show_on(85.0, 9);
  show.play(3000);
  EXPECT_EQ(show.keeper.rung(), 4U);
  EXPECT_NEAR(show.record.rate_hz(), 30.0, 0.05 * 30.0);
}

TEST(RateKeeper, GoesOneRungAtATime) {
  SimulatedShow show = show_on(400.0, 0);
  show.play(500);
  for (std::size_t i = 1; i < show.rungs.size(); ++i) {
    EXPECT_LE(std::max(show.rungs[i], show.rungs[i - 1]) - std::min(show.rungs[i], show.rungs[i - 1]), 1U) << i;
  }
}

TEST(RateKeeper, LeavesASpikeAlone) {
  SimulatedShow show = show_on(85.0, 4);
  show.slowness = [](long i) { return i % 100 == 50 ? 8.0 : 1.0; };
  show.play(3000);
  EXPECT_EQ(show.keeper.changes(), 0);
}

TEST(RateKeeper, HoldsTheRateOnANoisyMachine) {
  SimulatedShow show = show_on(85.0, 0);
  std::mt19937 random(5);
  std::normal_distribution<double> spread(0.0, 0.15);
  show.slowness = [&](long) { return std::exp(spread(random)); };
  show.play(6000);
  EXPECT_NEAR(show.record.rate_hz(), 30.0, 0.05 * 30.0);
  // 5,400 frames at 30 Hz are 180 s; the keeper changes the rung at most once in 15 s of them.
  EXPECT_LT(show.changes_after(600), 5400 / (15 * 30));
}

TEST(RateKeeper, FollowsAMachineThatGetsSlowerAndQuickerAgain) {
  SimulatedShow show = show_on(85.0, 4);
  show.play(500);
  EXPECT_EQ(show.keeper.rung(), 4U);
  show.slowness = [](long) { return 2.0; };
  show.play(1000);
  EXPECT_EQ(show.keeper.rung(), 6U);
  show.slowness = [](long) { return 1.0; };
  show.play(1500);
  EXPECT_EQ(show.keeper.rung(), 4U);
}

TEST(RateKeeper, DoesNotSwingBetweenRungsThatWereForetoldWrongly) {
  // The times of the two slowest rungs, 100 ms and 50 ms, are predicted as 22 ms and 21 ms.
  SimulatedShow show({100.0, 50.0, 20.0, 19.0}, {22.0, 21.0, 20.0, 19.0}, 2);
  show.play(9000);
  // 9,000 frames at 30 Hz are five minutes. The keeper tries a slower rung after 1, 2, 4, 8, 16,
  // 32, 60, 60, ... seconds; each attempt is two changes of the rung.
  EXPECT_LE(show.keeper.changes(), 2 * 12);
  EXPECT_NEAR(show.record.rate_hz(), 30.0, 0.05 * 30.0);
}

TEST(RateKeeper, StaysOnTheLastRungOfAMachineThatIsTooSlow) {
  SimulatedShow show = show_on(4000.0, 0);
  show.play(500);
  EXPECT_EQ(show.keeper.rung(), 9U);
  EXPECT_EQ(show.keeper.changes(), 9);
}

TEST(RateKeeper, GivesNothingUpForAWindowThatIsSlowByItself) {
  SimulatedShow show = show_on(16.0, 2);  // each frame takes 8 of the allowed 33 ms
  show.poll_ms = 40.0;
  show.play(1000);
  EXPECT_EQ(show.keeper.rung(), 0U);
}

TEST(RateKeeper, TakesALadderOfOneRung) {
  RateKeeper keeper({50.0}, 20.0, 0);
  for (int i = 0; i < 100; ++i) {
    keeper.note(50.0, 50.0);
  }
  EXPECT_EQ(keeper.rung(), 0U);
}

TEST(FramePace, MakesUpForFramesThatAreLittleLate) {
  FramePace pace(0.1);
  pace.begin(0.0);
  EXPECT_FALSE(pace.is_due(0.04));
  pace.begin(0.09);
  pace.begin(0.17);
  // The first three frames began at 0, 0.09 and 0.17 s. The pace now counts periods of 0.1 s from
  // 0.05 s, so the next frame is due at 0.25 s.
  EXPECT_FALSE(pace.is_due(0.24));
  EXPECT_TRUE(pace.is_due(0.26));
}

TEST(FramePace, DoesNotHurryAfterAPause) {
  FramePace pace(0.1);
  pace.begin(0.0);
  pace.begin(50.0);
  EXPECT_FALSE(pace.is_due(50.04));
  pace.begin(50.06);
  EXPECT_FALSE(pace.is_due(50.14));
}

}  // namespace
}  // namespace ergodome
