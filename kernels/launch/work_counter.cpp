#include "kernels/launch/work_counter.h"

#include <mutex>
#include <utility>
#include <vector>

namespace ergodome {

namespace {

struct Registry {
  std::mutex mutex;
  std::vector<const WorkCounter*> counters;
};

Registry& registry() {
  static Registry all;
  return all;
}

}  // namespace

WorkCounter::WorkCounter(std::string name) : name_(std::move(name)) {
  Registry& all = registry();
  const std::lock_guard lock(all.mutex);
  all.counters.push_back(this);
}

WorkCounter& work_counter(const std::string& name) {
  static std::mutex mutex;
  static std::map<std::string, WorkCounter> named;
  const std::lock_guard lock(mutex);
  return named.try_emplace(name, name).first->second;
}

void count_work(const std::string& name, long elements) { work_counter(name).count(elements); }

std::map<std::string, WorkCount> work_done() {
  Registry& all = registry();
  const std::lock_guard lock(all.mutex);
  std::map<std::string, WorkCount> done;
  for (const WorkCounter* counter : all.counters) {
    const WorkCount total = counter->total();
    WorkCount& sum = done[counter->name()];
    sum.runs += total.runs;
    sum.elements += total.elements;
    sum.time_ns += total.time_ns;
  }
  return done;
}

std::map<std::string, WorkCount> work_between(const std::map<std::string, WorkCount>& before,
                                              const std::map<std::string, WorkCount>& after) {
  std::map<std::string, WorkCount> between;
  for (const auto& [name, total] : after) {
    const auto earlier = before.find(name);
    const WorkCount start = earlier != before.end() ? earlier->second : WorkCount{};
    if (total.runs > start.runs) {
      between[name] = {total.runs - start.runs, total.elements - start.elements, total.time_ns - start.time_ns};
    }
  }
  return between;
}

}  // namespace ergodome
