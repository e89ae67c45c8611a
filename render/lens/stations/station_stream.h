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

// Reads baked stations into memory before the play head reaches them.

namespace ergodome {

//! The stations before and after a moment of a show. `second` is empty where the camera stands
//! still, at the ends of the path, and if only one of them can be read.
struct StationPair {
  std::shared_ptr<const StationBuffers> first;
  std::shared_ptr<const StationBuffers> second;
  //! Disk layers of both stations, in host memory; empty on a GPU and if the bake has none.
  std::shared_ptr<const DiskStation> first_disk;
  std::shared_ptr<const DiskStation> second_disk;
  //! Error of blending the disks [px] (StationEntry::disk_gap_error_px); infinite if a station
  //! between them could not be read.
  float disk_gap_error_px = 0.0F;
  //! Error of blending the lenses, as measured by the bake [px] (StationEntry::gap_error_px); 0 if
  //! `second` is empty.
  float gap_error_px = 0.0F;
  //! True if a nearer station could not be read; the blending error is then unknown.
  bool skips = false;
};

//! Counts what a stream has done so far.
struct StreamStatistics {
  long asked = 0;       //!< calls of StationStream::at()
  long waits = 0;       //!< calls for which the stations were not yet in memory
  long missed = 0;      //!< calls that returned nothing
  long read = 0;        //!< stations read
  long bad = 0;         //!< stations that could not be read
  long lost_disks = 0;  //!< disk layers that could not be read although their stations could
  std::size_t bytes_held = 0;
  std::size_t max_bytes_held = 0;
};

//! Keeps the stations around a show's play head in memory. A thread reads ahead, mostly in the
//! direction of play. Memory is bounded, however long the trajectory is.
class StationStream {
 public:
  //! Receives a message for the operator, once for each station that cannot be read. Called on the
  //! stream's thread.
  using Report = std::function<void(const std::string&)>;

  static constexpr std::size_t default_memory_bytes = std::size_t{256} << 20U;

  //! Starts reading. Keeps at least the two stations around the play head in memory, even if these
  //! exceed `memory_bytes`.
  StationStream(Backend backend, TrajectoryReader trajectory, std::size_t memory_bytes, Report report);
  ~StationStream();
  StationStream(const StationStream&) = delete;
  StationStream& operator=(const StationStream&) = delete;

  [[nodiscard]] const TrajectoryReader& trajectory() const { return trajectory_; }

  //! Moves the play head to a show time and returns the stations around it. Skips stations that
  //! cannot be read. Returns nothing if one of the two does not arrive within `patience_s`, or if
  //! no station can be read.
  std::optional<StationPair> at(double time_s, double patience_s);

  //! Like at(), but uses only stations that are in memory and does not move the play head.
  [[nodiscard]] std::optional<StationPair> at_hand(double time_s) const;

  [[nodiscard]] StreamStatistics statistics() const;

 private:
  //! A station in memory.
  struct Held {
    std::shared_ptr<const StationBuffers> lens;
    std::shared_ptr<const DiskStation> disk;
    std::size_t bytes = 0;
    bool lost_disk = false;  //!< the station has a disk that cannot be read
  };

  //! Indices of the readable stations around a moment. Both indices are the same if one station
  //! suffices or only one is readable.
  struct Bracket {
    std::size_t first = 0;
    std::size_t second = 0;
    bool skips = false;  //!< true if nearer stations could not be read
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
  double speed_ = 0.0;  //!< speed of the play head, in show seconds per second
  std::chrono::steady_clock::time_point moved_ = std::chrono::steady_clock::now();
  StreamStatistics statistics_;
  std::jthread thread_;
};

}  // namespace ergodome
