#include "render/passes/stars/refinement/lane_queue.h"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>

namespace ergodome {
namespace {

//! Test items that need rounds of work of three kinds, one kind after the other. The number of an
//! item determines how many rounds of each kind it needs.
class LanesOfThings : public testing::Test {
 protected:
  static constexpr std::size_t count = 40000;
  static constexpr std::array<std::size_t, 3> lanes = {16, 8, 4};
  static constexpr std::size_t max_rounds = 3 * lanes.size();

  static std::size_t rounds_of(std::size_t thing, std::size_t kind) { return (thing >> (2 * kind)) % 4; }

  //! Returns the kind of the next round that an item needs; nothing if it has finished.
  [[nodiscard]] std::optional<std::size_t> next_of(std::size_t thing) const {
    std::size_t before = 0;
    for (std::size_t kind = 0; kind < lanes.size(); ++kind) {
      before += rounds_of(thing, kind);
      if (done_[thing].size() < before) {
        return kind;
      }
    }
    return std::nullopt;
  }

  void run() {
    LaneQueue<3> queue(lanes);
    for (std::size_t thing = 0; thing < count; ++thing) {
      if (const auto kind = next_of(thing)) {
        queue.add(*kind, thing);
      }
    }
    queue.run(
        [&](std::size_t kind, std::span<const std::size_t> things) {
          too_large_ = too_large_ || things.size() > lanes[kind];
          lots_not_full_ += things.size() < lanes[kind] ? 1 : 0;
          for (const std::size_t thing : things) {
            done_[thing].push_back(kind);
          }
        },
        [&](std::size_t thing) { return next_of(thing); });
  }

  std::vector<std::vector<std::size_t>> done_ = std::vector<std::vector<std::size_t>>(count);
  std::atomic<bool> too_large_ = false;
  std::atomic<std::size_t> lots_not_full_ = 0;
};

TEST_F(LanesOfThings, GoThroughAllTheirRoundsInOrder) {
  run();
  for (std::size_t thing = 0; thing < count; ++thing) {
    std::vector<std::size_t> expected;
    for (std::size_t kind = 0; kind < lanes.size(); ++kind) {
      expected.insert(expected.end(), rounds_of(thing, kind), kind);
    }
    EXPECT_EQ(done_[thing], expected) << thing;
  }
}

TEST_F(LanesOfThings, AreNeverMoreThanThereAreLanes) {
  run();
  EXPECT_FALSE(too_large_);
}

TEST_F(LanesOfThings, AreAsManyAsThereAreLanesUntilFewAreLeft) {
  run();
  // A batch that is not full is processed only if no kind has enough items for a full batch. Then
  // only `waiting_at_most` items wait, and at most one batch is being processed per thread. In the
  // worst case, each remaining round of these items is a separate batch.
  const std::size_t waiting_at_most = std::accumulate(lanes.begin(), lanes.end(), std::size_t{0}) - lanes.size();
  const std::size_t left_at_most = waiting_at_most + lanes.front() * static_cast<std::size_t>(thread_count());
  EXPECT_LE(lots_not_full_, max_rounds * left_at_most);
  EXPECT_LT(max_rounds * left_at_most, count)
      << "more than that come where all lots are small: there must be more things";
}

TEST(LaneQueue, OfNothingEndsAtOnce) {
  LaneQueue<3> queue({16, 8, 4});
  std::atomic<int> lots = 0;
  queue.run([&](std::size_t, std::span<const std::size_t>) { ++lots; },
            [](std::size_t) { return std::optional<std::size_t>(); });
  EXPECT_EQ(lots, 0);
}

}  // namespace
}  // namespace ergodome
