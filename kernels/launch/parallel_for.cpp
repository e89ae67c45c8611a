#include "kernels/launch/parallel_for.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <thread>

#include "kernels/launch/background_work.h"
#include "kernels/launch/worker_pool.h"

namespace ergodome {

namespace {

//! Number of BackgroundWork objects of a thread.
thread_local int background_works = 0;

int choose_thread_count() {
  const char* wish = std::getenv("ERGODOME_THREADS");
  const int wished = wish != nullptr ? std::atoi(wish) : 0;
  const int present = static_cast<int>(std::thread::hardware_concurrency());
  return std::clamp(wished > 0 ? wished : present, 1, 256);
}

}  // namespace

BackgroundWork::BackgroundWork() { ++background_works; }

BackgroundWork::~BackgroundWork() { --background_works; }

int thread_count() {
  static const int count = choose_thread_count();
  return count;
}

void parallel_for(int count, int grain, const std::function<void(int, int)>& body) {
  if (count <= 0) {
    return;
  }
  const int chunk = std::max(grain, 1);
  const int chunks = (count - 1) / chunk + 1;
  std::atomic<int> next{0};
  const auto work = [&] {
    for (int i = next.fetch_add(1); i < chunks; i = next.fetch_add(1)) {
      body(i * chunk, std::min(count - i * chunk, chunk) + i * chunk);
    }
  };
  static WorkerPool& pool = *new WorkerPool(thread_count() - 1);
  pool.run(background_works > 0 ? 0 : std::min(thread_count(), chunks) - 1, std::ref(work));
}

}  // namespace ergodome
