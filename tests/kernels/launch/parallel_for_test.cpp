#include "kernels/launch/parallel_for.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#include "kernels/launch/worker_pool.h"

namespace ergodome {
namespace {

TEST(ParallelFor, TouchesEveryIndexOnceWhateverTheGrain) {
  for (const int count : {0, 1, 7, 1000}) {
    for (const int grain : {0, 1, 3, 5000}) {
      std::vector<std::atomic<int>> touched(static_cast<std::size_t>(count));
      parallel_for(count, grain, [&](int begin, int end) {
        for (int i = begin; i < end; ++i) {
          ++touched[static_cast<std::size_t>(i)];
        }
      });
      for (const auto& times : touched) {
        EXPECT_EQ(times, 1);
      }
    }
  }
}

TEST(ParallelFor, CountsUpToTheLargestNumberOfIndices) {
  std::atomic<long> sum{0};
  parallel_for(2147483647, 1 << 28, [&](int begin, int end) { sum += end - begin; });
  EXPECT_EQ(sum, 2147483647L);
}

TEST(ParallelFor, CanBeCalledFromWithinItself) {
  std::atomic<int> sum{0};
  for (int round = 0; round < 200; ++round) {
    parallel_for(
        8, 1, [&](int /*begin*/, int /*end*/) { parallel_for(5, 1, [&](int begin, int end) { sum += end - begin; }); });
  }
  EXPECT_EQ(sum, 200 * 8 * 5);
}

TEST(ParallelFor, ServesManyThreadsAtOnce) {
  std::atomic<int> sum{0};
  {
    std::vector<std::jthread> callers;
    callers.reserve(6);
    for (int i = 0; i < 6; ++i) {
      callers.emplace_back([&] {
        for (int round = 0; round < 300; ++round) {
          parallel_for(7, 2, [&](int begin, int end) { sum += end - begin; });
        }
      });
    }
  }
  EXPECT_EQ(sum, 6 * 300 * 7);
}

//! Returns a pool with five helper threads, more than some test machines have CPUs. Pools must not
//! be destroyed.
WorkerPool& pool_of_five() {
  static WorkerPool& pool = *new WorkerPool(5);
  return pool;
}

TEST(WorkerPool, ReturnsWhenAllHaveReturned) {
  for (int round = 0; round < 500; ++round) {
    std::atomic<int> at_it{0};
    std::atomic<int> left{40};
    pool_of_five().run(5, [&] {
      ++at_it;
      while (--left >= 0) {
      }
      --at_it;
    });
    ASSERT_EQ(at_it, 0);
    ASSERT_LT(left, 0);
  }
}

TEST(WorkerPool, AsksNoMoreHelpersThanAreWanted) {
  std::atomic<int> maximum{0};
  for (int round = 0; round < 200; ++round) {
    std::atomic<int> calls{0};
    pool_of_five().run(2, [&] {
      ++calls;
      std::this_thread::yield();
    });
    maximum = std::max(maximum.load(), calls.load());
  }
  EXPECT_GE(maximum, 1);
  EXPECT_LE(maximum, 3);
}

TEST(WorkerPool, IsNotNeededInAProcessThatWasForked) {
  parallel_for(64, 1, [](int, int) {});
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    std::atomic<int> sum{0};
    parallel_for(100, 1, [&](int begin, int end) { sum += end - begin; });
    ::_exit(sum == 100 ? 0 : 1);
  }
  int status = -1;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

}  // namespace
}  // namespace ergodome
