#include "app/budget/deadline.h"

#include <gtest/gtest.h>

namespace ergodome {
namespace {

//! A simulated clock: tests set its time, `now_s`.
struct ManualClock {
  double now_s = 100.0;
  [[nodiscard]] SecondsSource source() {
    return [this] { return now_s; };
  }
};

TEST(Deadline, DoesAsManyPiecesAsEndInTime) {
  ManualClock clock;
  Deadline deadline(clock.source(), 2.0);
  int done = 0;
  while (deadline.run(
      StartWork::lens, [&] { clock.now_s += 0.3; }, 1.0, 1.0)) {
    ++done;
  }
  EXPECT_EQ(done, 6);
  EXPECT_LE(deadline.elapsed_s(), 2.0);
  EXPECT_TRUE(deadline.cut_short());
}

TEST(Deadline, LeavesRoomForAPieceThatGrows) {
  ManualClock clock;
  Deadline deadline(clock.source(), 2.0);
  double piece_s = 0.2;
  while (deadline.run(
      StartWork::lens, [&] { clock.now_s += piece_s; }, 1.0, 1.5)) {
    piece_s *= 1.5;
  }
  EXPECT_LE(deadline.elapsed_s(), 2.0);
}

TEST(Deadline, KnowsTheTimeOfEachKindOfWork) {
  ManualClock clock;
  Deadline deadline(clock.source(), 2.0);
  ASSERT_TRUE(deadline.run(StartWork::picture, [&] { clock.now_s += 0.9; }));
  EXPECT_FALSE(deadline.run(StartWork::picture, [] {}));
  EXPECT_TRUE(deadline.run(StartWork::lens, [] {}));
}

TEST(Deadline, KeepsAShareOfTheTimeForLater) {
  ManualClock clock;
  Deadline deadline(clock.source(), 2.0);
  clock.now_s += 1.1;
  EXPECT_FALSE(deadline.run(
      StartWork::lens, [] {}, 0.5));
  EXPECT_TRUE(deadline.run(
      StartWork::lens, [] {}, 1.0));
}

TEST(Deadline, BeginsNothingThatIsExpectedToTakeLonger) {
  ManualClock clock;
  Deadline deadline(clock.source(), 2.0);
  EXPECT_FALSE(deadline.run(
      StartWork::picture, [] {}, 1.0, 1.0, 2.1));
  clock.now_s += 1.6;
  EXPECT_FALSE(deadline.run(StartWork::lens, [] {})) << "of a kind that nothing is known of";
}

TEST(Deadline, IsNotCutShortWhereAllWasDone) {
  ManualClock clock;
  Deadline deadline(clock.source(), 2.0);
  deadline.run(StartWork::lens, [&] { clock.now_s += 0.1; });
  EXPECT_FALSE(deadline.cut_short());
}

}  // namespace
}  // namespace ergodome
