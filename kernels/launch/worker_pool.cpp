#include "kernels/launch/worker_pool.h"

#include <pthread.h>

#include <algorithm>
#include <chrono>
#include <thread>

namespace ergodome {

namespace {

//! How long threads spin before they sleep. Falling asleep and waking up takes tens of
//! microseconds, and the next work mostly comes within this time.
constexpr std::chrono::microseconds patience{60};

//! True in a forked process, which has none of its parent's helpers: run() then only uses the
//! calling thread.
std::atomic<bool> forked{false};

//! Polls a condition for the time `patience`, and yields to other threads in between. Returns
//! whether it became true.
template <class Happened>
bool happens_soon(const Happened& happened) {
  const auto end = std::chrono::steady_clock::now() + patience;
  do {
    for (int i = 0; i < 16; ++i) {
      if (happened()) {
        return true;
      }
    }
    std::this_thread::yield();
  } while (std::chrono::steady_clock::now() < end);
  return false;
}

}  // namespace

WorkerPool::WorkerPool(int helpers) {
  pthread_atfork(nullptr, nullptr, [] { forked = true; });
  for (int i = 0; i < helpers; ++i) {
    std::thread([this] { help(); }).detach();
  }
}

void WorkerPool::run(int max_helpers, const std::function<void()>& work) {
  if (max_helpers <= 0 || forked) {
    work();
    return;
  }
  Job job{&work, max_helpers};
  {
    const std::lock_guard lock(mutex_);
    jobs_.push_back(&job);
    ++waiting_;
  }
  for (int i = 0; i < max_helpers; ++i) {
    asked_.notify_one();
  }
  work();
  {
    const std::lock_guard lock(mutex_);
    waiting_ -= static_cast<int>(std::erase(jobs_, &job));
  }
  wait_for_helpers(job);
}

void WorkerPool::help() {
  while (true) {
    Job* const job = wait_for_job();
    (*job->work)();
    // After this decrement, run() may return and destroy the job.
    --job->helpers;
    const std::lock_guard lock(mutex_);
    done_.notify_all();
  }
}

WorkerPool::Job* WorkerPool::wait_for_job() {
  happens_soon([this] { return waiting_ > 0; });
  std::unique_lock lock(mutex_);
  asked_.wait(lock, [this] { return !jobs_.empty(); });
  Job* const job = jobs_.front();
  ++job->helpers;
  if (--job->wanted == 0) {
    jobs_.pop_front();
    --waiting_;
  }
  return job;
}

void WorkerPool::wait_for_helpers(const Job& job) {
  const auto all_left = [&job] { return job.helpers == 0; };
  if (!happens_soon(all_left)) {
    std::unique_lock lock(mutex_);
    done_.wait(lock, all_left);
  }
}

}  // namespace ergodome
