#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <list>
#include <mutex>

namespace ergodome {

//! Threads that wait for work: starting one for each piece would cost more than many pieces do.
//!
//! Any number of threads may ask at once, a helper in the midst of its work too: who asks works as well, and so never waits for helpers
//! that are busy elsewhere.
class WorkerPool {
 public:
  //! The helpers live as long as the process, and so does the pool: make it by new, and never delete it. Joining them at the end of a
  //! process that was forked would wait for threads that it does not have.
  explicit WorkerPool(int helpers);

  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  //! Calls `work` on the calling thread, and meanwhile on up to `most_helpers` of those that are free; returns when all have returned.
  //! `work` must not throw, and ends at once where nothing is left to do.
  void run(int most_helpers, const std::function<void()>& work);

 private:
  //! What is asked for.
  struct Job {
    const std::function<void()>* work;
    int wanted;                   //!< helpers that may still come
    std::atomic<int> helpers{0};  //!< that are at it
  };

  void help();
  Job* wait_for_job();
  void wait_for_helpers(const Job& job);

  std::mutex mutex_;
  std::condition_variable asked_;
  std::condition_variable done_;
  std::list<Job*> jobs_;         //!< that want helpers
  std::atomic<int> waiting_{0};  //!< how many these are
};

}  // namespace ergodome
