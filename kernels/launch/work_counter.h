#pragma once

#include <atomic>
#include <chrono>
#include <map>
#include <string>

// Counts work and its time.
namespace ergodome {

//! Totals of one kind of work since the program began.
struct WorkCount {
  long runs = 0;
  long elements = 0;  //!< rays, pixels, stars or bytes, depending on the work
  long time_ns = 0;   //!< wall-clock time, including nested work
};

//! Counts one kind of work: launches of a kernel, passes over a picture, bytes of a buffer. Make it
//! a static variable where the work is done; any thread may count.
//!
//! Counters of the same name add up. Names are those of a frame plan (render/plan/frame_plan.h).
class WorkCounter {
 public:
  explicit WorkCounter(std::string name);

  void count(long elements) {
    runs_.fetch_add(1, std::memory_order_relaxed);
    elements_.fetch_add(elements, std::memory_order_relaxed);
  }

  void add_time(long time_ns) { time_ns_.fetch_add(time_ns, std::memory_order_relaxed); }

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] WorkCount total() const {
    return {runs_.load(std::memory_order_relaxed), elements_.load(std::memory_order_relaxed),
            time_ns_.load(std::memory_order_relaxed)};
  }

 private:
  std::string name_;
  std::atomic<long> runs_{0};
  std::atomic<long> elements_{0};
  std::atomic<long> time_ns_{0};
};

//! Counts a piece of work and its time, until the end of the scope.
class WorkScope {
 public:
  WorkScope(WorkCounter& counter, long elements) : counter_(counter), begin_(std::chrono::steady_clock::now()) {
    counter.count(elements);
  }
  ~WorkScope() {
    const auto time = std::chrono::steady_clock::now() - begin_;
    counter_.add_time(std::chrono::duration_cast<std::chrono::nanoseconds>(time).count());
  }
  WorkScope(const WorkScope&) = delete;
  WorkScope& operator=(const WorkScope&) = delete;

 private:
  WorkCounter& counter_;
  std::chrono::steady_clock::time_point begin_;
};

//! Returns the counter of a name that is only known at run time; slower than a static one.
WorkCounter& work_counter(const std::string& name);
void count_work(const std::string& name, long elements);

//! Returns all work since the program began, by the names of the counters.
std::map<std::string, WorkCount> work_done();

//! Returns the differences between two results of work_done(), without work that did not run in
//! between.
std::map<std::string, WorkCount> work_between(const std::map<std::string, WorkCount>& before,
                                              const std::map<std::string, WorkCount>& after);

}  // namespace ergodome
