#pragma once

#include <algorithm>
#include <array>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "kernels/launch/parallel_for.h"

namespace ergodome {

//! Work in rounds on many things, of which each goes on by itself until it is done: threads take them by the lot, a lot being what one
//! call does in the time of one, and hand back what goes on. No round waits for the others.
//!
//! Things are numbers, and rounds of one of some kinds, which are not mixed in a lot; higher ones come later in a thing's life.
template <std::size_t Kinds>
class LaneQueue {
 public:
  //! `lanes`: how many things make a full lot, at most `most_lanes`.
  explicit LaneQueue(const std::array<std::size_t, Kinds>& lanes) : lanes_(lanes) {}

  static constexpr std::size_t most_lanes = 16;

  //! Things to begin with; those that come last begin first.
  void add(std::size_t kind, std::size_t thing) { waiting_[kind].push_back(thing); }

  //! Does it all, on all threads. `work(kind, things)` does a round; `next(thing)` then says of which kind that thing's next round is, if it
  //! has one. Both are called by many threads at once, and must not throw.
  template <class Work, class Next>
  void run(const Work& work, const Next& next) {
    const int threads = std::min(thread_count(), static_cast<int>(lots_waiting()));
    parallel_for(threads, 1, [&](int /*begin*/, int /*end*/) { help(work, next); });
  }

 private:
  struct Lot {
    std::size_t kind = 0;
    std::size_t count = 0;
    std::array<std::size_t, most_lanes> things{};
  };

  template <class Work, class Next>
  void help(const Work& work, const Next& next) {
    std::unique_lock lock(mutex_);
    while (true) {
      Lot lot = take();
      if (lot.count == 0) {
        if (in_work_ == 0) {
          return;
        }
        changed_.wait(lock);
        continue;
      }
      ++in_work_;
      lock.unlock();
      const std::span things(lot.things.data(), lot.count);
      work(lot.kind, things);
      std::array<std::optional<std::size_t>, most_lanes> kinds;
      std::ranges::transform(things, kinds.begin(), next);
      lock.lock();
      --in_work_;
      give_back(things, kinds);
    }
  }

  //! A full lot of the highest kind that has one, or else what there is of the highest. Those that came last go first: what has gone through
  //! many rounds goes through many more, and nobody shall wait for it in the end.
  Lot take() {
    std::size_t chosen = Kinds;
    for (std::size_t kind = 0; kind < Kinds; ++kind) {
      const bool full = waiting_[kind].size() >= lanes_[kind];
      if (full || (!waiting_[kind].empty() && (chosen == Kinds || waiting_[chosen].size() < lanes_[chosen]))) {
        chosen = kind;
      }
    }
    Lot lot;
    if (chosen < Kinds) {
      std::vector<std::size_t>& from = waiting_[chosen];
      lot.kind = chosen;
      lot.count = std::min(from.size(), lanes_[chosen]);
      std::copy_n(from.end() - static_cast<std::ptrdiff_t>(lot.count), lot.count, lot.things.begin());
      from.resize(from.size() - lot.count);
    }
    return lot;
  }

  void give_back(std::span<const std::size_t> things, const std::array<std::optional<std::size_t>, most_lanes>& kinds) {
    for (std::size_t i = 0; i < things.size(); ++i) {
      if (kinds[i]) {
        waiting_[*kinds[i]].push_back(things[i]);
      }
    }
    // This thread takes one lot itself.
    const std::size_t lots = lots_waiting();
    if (lots > 1 || (lots == 0 && in_work_ == 0)) {
      changed_.notify_all();
    }
  }

  [[nodiscard]] std::size_t lots_waiting() const {
    std::size_t lots = 0;
    for (std::size_t kind = 0; kind < Kinds; ++kind) {
      lots += (waiting_[kind].size() + lanes_[kind] - 1) / lanes_[kind];
    }
    return lots;
  }

  std::array<std::size_t, Kinds> lanes_;
  std::array<std::vector<std::size_t>, Kinds> waiting_;
  std::size_t in_work_ = 0;
  std::mutex mutex_;
  std::condition_variable changed_;
};

}  // namespace ergodome
