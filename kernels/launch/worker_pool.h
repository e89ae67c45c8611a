#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <list>
#include <mutex>

namespace ergodome {

//! Threads that wait for work, because starting a thread for each piece would cost more than many
//! pieces do.
//!
//! Any number of threads may call run() at once, even a helper during its work. The calling thread
//! works as well, so it never waits for helpers that are busy elsewhere.
class WorkerPool {
 public:
  //! Starts the helpers, which live as long as the process. The pool must live as long: create it
  //! with new, and never delete it. A destructor that joins the helpers would wait forever in a
  //! forked process, which has no helpers.
  explicit WorkerPool(int helpers);

  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  //! Calls `work` on the calling thread and on up to `max_helpers` free helpers at the same time.
  //! Returns when all calls have returned. `work` must not throw, and must return at once if
  //! nothing is left to do.
  void run(int max_helpers, const std::function<void()>& work);

 private:
  //! A call of run() that is in progress.
  struct Job {
    const std::function<void()>* work;
    int wanted;                   //!< helpers that may still join
    std::atomic<int> helpers{0};  //!< helpers that are working
  };

  void help();
  Job* wait_for_job();
  void wait_for_helpers(const Job& job);

  std::mutex mutex_;
  std::condition_variable asked_;
  std::condition_variable done_;
  std::list<Job*> jobs_;         //!< jobs that want helpers
  std::atomic<int> waiting_{0};  //!< number of jobs in jobs_
};

}  // namespace ergodome
