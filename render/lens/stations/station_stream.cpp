#include "render/lens/stations/station_stream.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <unordered_set>
#include <utility>

namespace ergodome {

namespace {

//! Of this many stations that are read in advance, one is behind the play head and the others are
//! ahead of it.
constexpr std::size_t ahead_of_one_behind = 4;
//! Time before their use at which stations are read [s], at the current speed of the play head or
//! at normal speed, whichever is faster.
constexpr double look_ahead_s = 5.0;
//! Number of stations around the play head that are read if memory suffices, however far apart they
//! are.
constexpr std::size_t min_around = 6;
//! Maximum speed of the play head [show seconds per second]; a faster movement is a jump, which
//! does not count for its measured speed.
constexpr double fastest = 64.0;

}  // namespace

StationStream::StationStream(Backend backend, TrajectoryReader trajectory, std::size_t memory_bytes, Report report)
    : backend_(backend),
      trajectory_(std::move(trajectory)),
      memory_bytes_(memory_bytes),
      report_(std::move(report)),
      thread_([this](const std::stop_token& stop) { work(stop); }) {}

StationStream::~StationStream() {
  thread_.request_stop();
  wake_.notify_all();
}

StreamStatistics StationStream::statistics() const {
  const std::lock_guard lock(mutex_);
  return statistics_;
}

bool StationStream::reads_disk(std::size_t station) const {
  return backend_ == Backend::cpu && trajectory_.stations()[station].disk_bytes > 0;
}

std::size_t StationStream::bytes_of(std::size_t station) const {
  const auto found = held_.find(station);
  if (found != held_.end()) {
    return found->second.bytes;
  }
  const StationEntry& entry = trajectory_.stations()[station];
  return StationBuffers::expected_bytes(entry, trajectory_.provenance().derivatives) +
         (reads_disk(station) ? entry.disk_memory_bytes : 0);
}

std::optional<StationStream::Bracket> StationStream::around(double time_s) const {
  const std::vector<StationEntry>& all = trajectory_.stations();
  const auto later = std::upper_bound(all.begin(), all.end(), time_s,
                                      [](double t, const StationEntry& station) { return t < station.time_s; });
  const auto after = static_cast<std::size_t>(later - all.begin());
  std::size_t first = after > 0 ? after - 1 : 0;
  std::size_t second = std::min(after, all.size() - 1);
  const auto at_one_position = [&](std::size_t a, std::size_t b) {
    return all[a].r == all[b].r && all[a].theta == all[b].theta;
  };
  // Where the camera stands still, and at the exact time of a station, one station suffices if the
  // other cannot be read.
  const bool first_serves = all[first].time_s == time_s || at_one_position(first, second);
  if (first_serves && bad_.contains(second) && !bad_.contains(first)) {
    return Bracket{first, first, false};
  }
  if (at_one_position(first, second) && bad_.contains(first) && !bad_.contains(second)) {
    return Bracket{second, second, false};
  }
  const bool skips = bad_.contains(first) || bad_.contains(second);
  while (first > 0 && bad_.contains(first)) {
    --first;
  }
  while (second + 1 < all.size() && bad_.contains(second)) {
    ++second;
  }
  first = bad_.contains(first) ? second : first;
  second = bad_.contains(second) ? first : second;
  if (bad_.contains(first)) {
    return std::nullopt;
  }
  return Bracket{first, at_one_position(first, second) ? first : second, skips};
}

void StationStream::move_head(double time_s) {
  const auto now = std::chrono::steady_clock::now();
  const auto bracket = around(time_s);
  if (time_s != head_s_) {
    const double wall_s = std::max(std::chrono::duration<double>(now - moved_).count(), 1e-3);
    const double speed = (time_s - head_s_) / wall_s;
    // A jump, as at the end of a loop, does not predict the head's speed.
    if (std::abs(speed) < fastest) {
      speed_ += 0.25 * (speed - speed_);
    }
    moved_ = now;
  }
  head_s_ = time_s;
  head_ = bracket ? bracket->first : head_;
}

std::vector<std::size_t> StationStream::wanted() const {
  const std::vector<StationEntry>& all = trajectory_.stations();
  std::vector<std::size_t> order;
  std::unordered_set<std::size_t> seen;
  std::size_t bytes = 0;
  const auto add = [&](std::size_t station, bool needed) {
    if (bad_.contains(station) || !seen.insert(station).second) {
      return true;
    }
    bytes += bytes_of(station);
    if (bytes > memory_bytes_ && !needed) {
      return false;
    }
    order.push_back(station);
    return true;
  };
  if (const auto bracket = around(head_s_)) {
    add(bracket->first, true);
    add(bracket->second, true);
  }
  const double reach_s = look_ahead_s * std::max(1.0, std::abs(speed_));
  std::size_t ahead = head_;
  std::size_t behind = head_;
  const auto step = [&](std::size_t& from, bool back) {
    // Continues at the other end, because shows loop.
    from = back ? (from + all.size() - 1) % all.size() : (from + 1) % all.size();
    return from;
  };
  for (std::size_t i = 1; i < all.size(); ++i) {
    const bool opposite = i % ahead_of_one_behind == 0;
    const std::size_t next = step(opposite ? behind : ahead, opposite != (speed_ < 0.0));
    const bool far = std::abs(all[next].time_s - head_s_) > reach_s;
    if ((far && i > min_around) || !add(next, false)) {
      break;
    }
  }
  return order;
}

std::optional<std::size_t> StationStream::next_to_read() {
  const std::vector<std::size_t> order = wanted();
  const auto missing = std::find_if(order.begin(), order.end(), [&](std::size_t i) { return !held_.contains(i); });
  if (missing == order.end()) {
    return std::nullopt;
  }
  make_room(bytes_of(*missing), order);
  return *missing;
}

void StationStream::make_room(std::size_t bytes, const std::vector<std::size_t>& order) {
  const std::unordered_set<std::size_t> keep(order.begin(), order.end());
  while (statistics_.bytes_held + bytes > memory_bytes_) {
    // Evicts stations that are not in `order`, the one farthest from the play head first.
    const auto distance = [&](const auto& each) {
      return std::abs(static_cast<double>(each.first) - static_cast<double>(head_));
    };
    auto farthest = held_.end();
    for (auto each = held_.begin(); each != held_.end(); ++each) {
      if (!keep.contains(each->first) && (farthest == held_.end() || distance(*each) > distance(*farthest))) {
        farthest = each;
      }
    }
    if (farthest == held_.end()) {
      return;
    }
    statistics_.bytes_held -= farthest->second.bytes;
    held_.erase(farthest);
  }
}

StationStream::Held StationStream::read_from_file(std::size_t station) const {
  Held fresh;
  fresh.lens = std::make_shared<const StationBuffers>(backend_, trajectory_.read(station));
  fresh.bytes = fresh.lens->bytes();
  if (reads_disk(station)) {
    try {
      fresh.disk = std::make_shared<const DiskStation>(trajectory_.read_disk(station));
      fresh.bytes += fresh.disk->bytes();
    } catch (const std::exception& error) {
      // The error is only reported, because the lens is usable without the disk.
      report_(error.what());
      fresh.lost_disk = true;
    }
  }
  return fresh;
}

void StationStream::read(std::size_t station, std::unique_lock<std::mutex>& lock) {
  lock.unlock();
  Held fresh;
  std::string problem;
  try {
    fresh = read_from_file(station);
  } catch (const std::exception& error) {
    problem = error.what();
    report_(problem);
  }
  lock.lock();
  if (fresh.lens) {
    statistics_.bytes_held += fresh.bytes;
    statistics_.max_bytes_held = std::max(statistics_.max_bytes_held, statistics_.bytes_held);
    ++statistics_.read;
    statistics_.lost_disks += fresh.lost_disk ? 1 : 0;
    held_[station] = std::move(fresh);
  } else {
    ++statistics_.bad;
    bad_.insert(station);
  }
  arrived_.notify_all();
}

void StationStream::work(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    if (const auto station = next_to_read()) {
      read(*station, lock);
    } else {
      const double seen_s = head_s_;
      wake_.wait(lock, stop, [&] { return head_s_ != seen_s; });
    }
  }
}

std::optional<StationPair> StationStream::held_pair(const Bracket& bracket) const {
  const auto& [first, second, skips] = bracket;
  const auto a = held_.find(first);
  const auto b = held_.find(second);
  if (a == held_.end() || b == held_.end()) {
    return std::nullopt;
  }
  if (first == second) {
    return StationPair{a->second.lens, nullptr, a->second.disk, nullptr, skips ? INFINITY : 0.0F, 0.0F, skips};
  }
  const StationEntry& entry = trajectory_.stations()[first];
  return StationPair{
      a->second.lens,     b->second.lens, a->second.disk, b->second.disk, skips ? INFINITY : entry.disk_gap_error_px,
      entry.gap_error_px, skips};
}

std::optional<StationPair> StationStream::at_hand(double time_s) const {
  const std::lock_guard lock(mutex_);
  const auto bracket = around(time_s);
  return bracket ? held_pair(*bracket) : std::nullopt;
}

std::optional<StationPair> StationStream::at(double time_s, double patience_s) {
  std::unique_lock lock(mutex_);
  ++statistics_.asked;
  move_head(time_s);
  wake_.notify_all();
  std::optional<StationPair> pair;
  // Sets `pair`. Returns true if the stations are in memory, or if none can be read, so that
  // waiting is useless.
  const auto arrived = [&] {
    const auto bracket = around(time_s);
    pair = bracket ? held_pair(*bracket) : std::nullopt;
    return pair.has_value() || !bracket;
  };
  if (!arrived()) {
    ++statistics_.waits;
    arrived_.wait_for(lock, std::chrono::duration<double>(std::min(patience_s, 1e6)), arrived);
  }
  statistics_.missed += pair ? 0 : 1;
  return pair;
}

}  // namespace ergodome
