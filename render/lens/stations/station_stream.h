#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <thread>
#include <vector>

#include "content/trajectory/trajectory_reader.h"
#include "render/lens/stations/station_blend.h"

namespace ergodome {

//! The stations around a moment of a show; the second is missing where the camera stands still and at the ends.
struct StationPair {
  std::shared_ptr<const StationBuffers> first;
  std::shared_ptr<const StationBuffers> second;
  std::shared_ptr<const DiskStation>
      first_disk;  //!< their disk layers, in host memory; none on a GPU, and where the bake has none
  std::shared_ptr<const DiskStation> second_disk;
  //! What blending these misses by [px] (StationEntry::disk_gap_error_px); infinite where a station between them could not be read.
  float disk_gap_error_px = 0.0F;
  //! What blending these misses by in the bake [px] (StationEntry::gap_error_px); 0 at a station.
  float gap_error_px = 0.0F;
  //! A station nearer to the moment could not be read: nothing is known of what these miss by there.
  bool skips = false;
};

//! What a stream has done so far.
struct StreamStatistics {
  long asked = 0;       //!< moments that were asked for
  long waits = 0;       //!< of them, those whose stations were not there at once
  long missed = 0;      //!< of them, those that were given up
  long read = 0;        //!< stations read
  long bad = 0;         //!< stations that could not be read
  long lost_disks = 0;  //!< disks of stations that were read, which could not be
  std::size_t bytes_held = 0;
  std::size_t most_bytes_held = 0;
};

//! Keeps the stations around a show's play head in memory, read ahead by a thread of its own, in the direction in which the head moves
//! and some in the other; memory stays bounded however long the trajectory is.
class StationStream {
 public:
  //! Takes a message for the person who watches; called from the stream's thread, once for each station that cannot be read.
  using Report = std::function<void(const std::string&)>;

  static constexpr std::size_t default_memory_bytes = std::size_t{256} << 20U;

  //! Holds at least the stations that a moment and its neighbour need, whatever the bound.
  StationStream(Backend backend, TrajectoryReader trajectory, std::size_t memory_bytes, Report report);
  ~StationStream();
  StationStream(const StationStream&) = delete;
  StationStream& operator=(const StationStream&) = delete;

  [[nodiscard]] const TrajectoryReader& trajectory() const { return trajectory_; }

  //! The stations around a show time, which becomes the play head. Stations that cannot be read are left out, and their neighbours taken.
  //! Nothing where they did not come within `patience_s`, or where none can be read.
  std::optional<StationPair> at(double time_s, double patience_s);

  //! The same of what is in memory, without moving the play head.
  [[nodiscard]] std::optional<StationPair> at_hand(double time_s) const;

  [[nodiscard]] StreamStatistics statistics() const;

 private:
  //! A station in memory.
  struct Held {
    std::shared_ptr<const StationBuffers> lens;
    std::shared_ptr<const DiskStation> disk;
    std::size_t bytes = 0;
    bool lost_disk = false;  //!< it has one that cannot be read
  };

  //! Stations around a moment that can be read, the same twice where one is all that is needed or there.
  struct Bracket {
    std::size_t first = 0;
    std::size_t second = 0;
    bool skips = false;  //!< there are others nearer to it
  };

  void work(const std::stop_token& stop);
  void move_head(double time_s);
  [[nodiscard]] std::vector<std::size_t> wanted() const;
  std::optional<std::size_t> next_to_read();
  void make_room(std::size_t bytes, const std::vector<std::size_t>& order);
  [[nodiscard]] std::optional<Bracket> around(double time_s) const;
  [[nodiscard]] bool reads_disk(std::size_t station) const;
  [[nodiscard]] std::size_t bytes_of(std::size_t station) const;
  [[nodiscard]] Held read_from_file(std::size_t station) const;
  [[nodiscard]] std::optional<StationPair> held_pair(const Bracket& bracket) const;
  void read(std::size_t station, std::unique_lock<std::mutex>& lock);

  Backend backend_;
  TrajectoryReader trajectory_;
  std::size_t memory_bytes_;
  Report report_;
  mutable std::mutex mutex_;
  std::condition_variable_any wake_;
  std::condition_variable_any arrived_;
  std::map<std::size_t, Held> held_;
  std::set<std::size_t> bad_;
  std::size_t head_ = 0;
  double head_s_ = 0.0;
  double speed_ = 0.0;  //!< of the head, in show seconds a second
  std::chrono::steady_clock::time_point moved_ = std::chrono::steady_clock::now();
  StreamStatistics statistics_;
  std::jthread thread_;
};

}  // namespace ergodome
