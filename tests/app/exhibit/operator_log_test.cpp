#include "app/exhibit/operator_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ergodome {
namespace {

using Kind = TransportCommand::Kind;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(OperatorLog, NamesTheChangeAndTheAddress) {
  OperatorLog log;
  log.note({{Kind::exposure, -1.5, {}, "web 192.0.2.7"}, {Kind::language, 0.0, "de", "OSC 192.0.2.8"}}, 10.0);
  log.note({{Kind::blackout, 1.0, {}, "OSC ::1"}, {Kind::reload, 0.0, {}, "web 127.0.0.1"}}, 10.0);
  EXPECT_THAT(log.take(11.0),
              ElementsAre("operator: exposure -1.5 (from web 192.0.2.7)", "operator: language de (from OSC 192.0.2.8)",
                          "operator: blackout on (from OSC ::1)", "operator: reload (from web 127.0.0.1)"));
  EXPECT_THAT(log.take(20.0), IsEmpty());
}

TEST(OperatorLog, MakesOneLineOfAFaderThatMoves) {
  OperatorLog log;
  for (int i = 1; i <= 20; ++i) {
    log.note({{Kind::volume, 0.01 * i, {}, "web 192.0.2.7"}}, 0.1 * i);
    EXPECT_THAT(log.take(0.1 * i), IsEmpty());
  }
  EXPECT_THAT(log.take(3.1), ElementsAre("operator: volume 0.2 (from web 192.0.2.7, 20 times)"));
}

TEST(OperatorLog, DoesNotWaitForEverForOneThatGoesOnMoving) {
  OperatorLog log;
  std::size_t lines = 0;
  for (int i = 0; i < 120; ++i) {
    log.note({{Kind::volume, 0.5, {}, "web 192.0.2.7"}}, 0.1 * i);
    lines += log.take(0.1 * i).size();
  }
  EXPECT_EQ(lines, 2U) << "one in five seconds";
}

TEST(OperatorLog, LeavesOutWhatTheProgramItselfDoes) {
  OperatorLog log;
  log.note({{Kind::reset, 0.0, {}}}, 0.0);
  EXPECT_THAT(log.take_all(), IsEmpty());
}

TEST(OperatorLog, KeepsNoMoreThanItMayOfManyAddresses) {
  OperatorLog log;
  for (int i = 0; i < 1000; ++i) {
    log.note({{Kind::play, 0.0, {}, "OSC 192.0.2." + std::to_string(i)}}, 0.0);
  }
  EXPECT_EQ(log.take(0.5).size(), 1000U - OperatorLog::max_waiting);
  EXPECT_EQ(log.take_all().size(), OperatorLog::max_waiting);
}

}  // namespace
}  // namespace ergodome
