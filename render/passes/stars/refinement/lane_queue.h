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

//! Work queue for many items, each of which needs a series of rounds. Threads take items in lots
//! and put back those that need another round. A SIMD computation processes a lot in the time of
//! one item. No item waits for the rounds of other items.
//!
//! An item is an index. Each round has one of `Kinds` kinds, which are not mixed within a lot; the
//! kind of an item's rounds never decreases.
template <std::size_t Kinds>
class LaneQueue {
 public:
  //! `lanes`: number of items in a full lot, for each kind; at most `max_lanes`.
  explicit LaneQueue(const std::array<std::size_t, Kinds>& lanes) : lanes_(lanes) {}

  static constexpr std::size_t max_lanes = 16;

  //! Adds an initial item. Items that are added last start first.
  void add(std::size_t kind, std::size_t thing) { waiting_[kind].push_back(thing); }

  //! Processes all items, on all threads. `work(kind, things)` performs a round; `next(thing)` then
  //! returns the kind of the item's next round, if any. Both are called concurrently and must not
  //! throw.
  template <class Work, class Next>
  void run(const Work& work, const Next& next) {
    const int threads = std::min(thread_count(), static_cast<int>(lots_waiting()));
    parallel_for(threads, 1, [&](int /*begin*/, int /*end*/) { help(work, next); });
  }

 private:
  struct Lot {
    std::size_t kind = 0;
    std::size_t count = 0;
    std::array<std::size_t, max_lanes> things{};
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
      std::array<std::optional<std::size_t>, max_lanes> kinds;
      std::ranges::transform(things, kinds.begin(), next);
      lock.lock();
      --in_work_;
      give_back(things, kinds);
    }
  }

  //! Takes a full lot of the highest kind that has one, or a partial lot of the highest nonempty
  //! kind. The most recent items come first: items that have needed many rounds will need many more
  //! and must not be left for the end.
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

  void give_back(std::span<const std::size_t> things, const std::array<std::optional<std::size_t>, max_lanes>& kinds) {
    for (std::size_t i = 0; i < things.size(); ++i) {
      if (kinds[i]) {
        waiting_[*kinds[i]].push_back(things[i]);
      }
    }
    // Wakes the other threads if there is another lot than the one that this thread takes next, or
    // if all work is done.
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
