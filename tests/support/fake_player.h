#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "app/playback/transport.h"

// A fake player, for tests of its remote controls.
namespace ergodome::test {

//! Returns the status of a player that plays a show of two minutes with three chapters and two
//! languages.
inline PlayerStatus example_status() {
  PlayerStatus status;
  status.title = "Once around";
  status.duration_s = 120.0;
  status.stereo = true;
  status.baseline = 0.1;
  status.languages = {"en", "de"};
  status.language = "en";
  status.chapters = {{0.0, "Departure", {"Departure", "Aufbruch"}},
                     {40.0, "The far side", {"The far side", "Drüben, näher"}},
                     {90.0, "Return", {"Return", "Rückkehr"}}};
  status.chapter = 0;
  status.observer = "geodesic orbit";
  status.lens = "streamed";
  status.backend = "CPU, AVX-512";
  status.frame_ms = 16.4;
  status.worst_frame_ms = 31.0;
  return status;
}

//! Changes a status in the way in which the player would execute a command.
inline void obey(const TransportCommand& command, PlayerStatus& status) {
  using Kind = TransportCommand::Kind;
  switch (command.kind) {
    case Kind::play:
      status.playing = true;
      break;
    case Kind::pause:
      status.playing = false;
      break;
    case Kind::seek:
      status.time_s = std::clamp(command.value, 0.0, status.duration_s);
      break;
    case Kind::step:
      status.playing = false;
      status.time_s += command.value / 60.0;
      break;
    case Kind::speed:
      status.speed = command.value;
      break;
    case Kind::chapter:
      status.time_s = status.chapters.at(static_cast<std::size_t>(command.value)).time_s;
      break;
    case Kind::loop:
      status.loop = command.value != 0.0;
      break;
    case Kind::blackout:
      status.blackout = command.value != 0.0;
      break;
    case Kind::exposure:
      status.exposure_stops = command.value;
      break;
    case Kind::baseline:
      status.baseline = command.value;
      break;
    case Kind::volume:
      status.volume = command.value;
      break;
    case Kind::captions:
      status.captions = command.value != 0.0;
      break;
    case Kind::language:
      status.language = command.text;
      break;
    case Kind::free_flight:
      status.free_flight = true;
      break;
    case Kind::return_to_path:
      status.free_flight = false;
      break;
    default:
      break;
  }
}

//! A fake player: a thread that executes commands, advances the time, and posts its status sixty
//! times a second.
class FakePlayer {
 public:
  FakePlayer() : status_(example_status()) {
    board.post(status_);
    thread_ = std::thread([this] { run(); });
  }
  ~FakePlayer() {
    stopping_ = true;
    thread_.join();
  }
  FakePlayer(const FakePlayer&) = delete;
  FakePlayer& operator=(const FakePlayer&) = delete;

  //! Changes the status that the fake player posts.
  void change(const std::function<void(PlayerStatus&)>& change) {
    const std::lock_guard lock(mutex_);
    change(status_);
  }

  CommandQueue commands;
  StatusBoard board;

 private:
  void run() {
    auto last = std::chrono::steady_clock::now();
    while (!stopping_) {
      std::this_thread::sleep_for(std::chrono::milliseconds(16));
      const auto now = std::chrono::steady_clock::now();
      const double elapsed_s = std::chrono::duration<double>(now - last).count();
      last = now;
      const std::lock_guard lock(mutex_);
      for (const TransportCommand& command : commands.take_all()) {
        obey(command, status_);
      }
      advance(elapsed_s);
      board.post(status_);
    }
  }

  void advance(double elapsed_s) {
    if (status_.playing) {
      status_.time_s = std::clamp(status_.time_s + elapsed_s * status_.speed, 0.0, status_.duration_s);
    }
    ++status_.frames;
    status_.frame_ms = 16.0 + 3.0 * static_cast<double>(status_.frames % 40) / 40.0;
    status_.chapter = -1;
    for (const ChapterStatus& chapter : status_.chapters) {
      status_.chapter += chapter.time_s <= status_.time_s ? 1 : 0;
    }
  }

  std::mutex mutex_;
  PlayerStatus status_;
  std::atomic<bool> stopping_ = false;
  std::thread thread_;
};

//! Checks a condition repeatedly. Returns whether it became true before the time ran out.
inline bool becomes_true(const std::function<bool()>& condition,
                         std::chrono::milliseconds while_long = std::chrono::seconds(10)) {
  const auto deadline = std::chrono::steady_clock::now() + while_long;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) {
      return false;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

}  // namespace ergodome::test
