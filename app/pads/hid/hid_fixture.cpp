#include "app/pads/hid/hid_fixture.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

namespace ergodome {

//! A device during playback. Times are in seconds of the player's clock. In a repeated timeline,
//! indices of events continue from one repetition to the next.
struct FixturePlayer::Playing {
  FixtureDevice device;
  std::function<double()> now_s;
  std::vector<std::vector<std::uint8_t>> sent;

  [[nodiscard]] const HidEvent& event(std::size_t index) const {
    return device.timeline[index % device.timeline.size()];
  }

  [[nodiscard]] double time_of(std::size_t index) const {
    const std::size_t round = index / device.timeline.size();
    return (device.repeat_s > 0.0 ? static_cast<double>(round) * device.repeat_s : 0.0) + event(index).t_s;
  }

  [[nodiscard]] bool is_end(std::size_t index) const {
    return device.timeline.empty() || (device.repeat_s <= 0.0 && index >= device.timeline.size());
  }

  //! Returns the index of the first event at or after a time.
  [[nodiscard]] std::size_t first_from(double t_s) const {
    const std::size_t round = device.repeat_s > 0.0 && t_s > 0.0 ? static_cast<std::size_t>(t_s / device.repeat_s) : 0;
    std::size_t index = round * device.timeline.size();
    while (!is_end(index) && time_of(index) < t_s) {
      ++index;
    }
    return index;
  }

  struct Situation {
    bool present = true;
    bool allowed = true;
    std::string path;
    std::uint64_t changes = 0;
  };

  //! Returns the state of the device after all events up to now.
  [[nodiscard]] Situation situation() const {
    Situation now{device.present, device.allowed, device.info.path, 0};
    const double t = now_s();
    const double round_start = device.repeat_s > 0.0 ? std::floor(t / device.repeat_s) * device.repeat_s : 0.0;
    if (round_start > 0.0) {
      follow(now, round_start);
      now.changes = static_cast<std::uint64_t>(round_start * 1000.0);
    }
    follow(now, t - round_start);
    return now;
  }

  void follow(Situation& now, double until_s) const {
    for (const HidEvent& event : device.timeline) {
      if (event.t_s > until_s) {
        break;
      }
      const auto changes_before = now.changes++;
      switch (event.kind) {
        case HidEvent::Kind::connect:
          now.present = true;
          now.path = event.path.empty() ? now.path : event.path;
          break;
        case HidEvent::Kind::disconnect:
          now.present = false;
          break;
        case HidEvent::Kind::allow:
        case HidEvent::Kind::deny:
          now.allowed = event.kind == HidEvent::Kind::allow;
          break;
        default:
          now.changes = changes_before;
      }
    }
  }
};

class FixturePlayer::Handle : public HidDevice {
 public:
  Handle(std::shared_ptr<Playing> playing, std::size_t next) : playing_(std::move(playing)), next_(next) {}

  int read_timeout(std::span<std::uint8_t> into, int milliseconds) override {
    const int got = read_due(into);
    if (got != 0 || milliseconds <= 0) {
      return got;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
    return read_due(into);
  }

  bool write(std::span<const std::uint8_t> report) override {
    playing_->sent.emplace_back(report.begin(), report.end());
    return true;
  }

  bool send_feature(std::span<const std::uint8_t> report) override { return write(report); }

  int get_feature(std::span<std::uint8_t> report) override {
    if (report.empty()) {
      return -1;
    }
    playing_->sent.push_back({report[0]});
    for (const auto& answer : playing_->device.features) {
      if (!answer.empty() && answer[0] == report[0]) {
        const std::size_t length = std::min(answer.size(), report.size());
        std::copy_n(answer.begin(), length, report.begin());
        return static_cast<int>(length);
      }
    }
    return -1;
  }

  std::vector<std::uint8_t> descriptor() override { return playing_->device.descriptor; }

 private:
  int read_due(std::span<std::uint8_t> into) {
    while (!gone_ && !playing_->is_end(next_) && playing_->time_of(next_) <= playing_->now_s()) {
      const HidEvent& event = playing_->event(next_++);
      if (event.kind == HidEvent::Kind::report) {
        const std::size_t length = std::min(event.bytes.size(), into.size());
        std::copy_n(event.bytes.begin(), length, into.begin());
        return static_cast<int>(length);
      }
      gone_ = event.kind == HidEvent::Kind::disconnect || event.kind == HidEvent::Kind::error;
    }
    return gone_ ? -1 : 0;
  }

  std::shared_ptr<Playing> playing_;
  std::size_t next_;
  bool gone_ = false;
};

FixturePlayer::FixturePlayer(HidFixture fixture, std::function<double()> now_s) {
  for (FixtureDevice& device : fixture.devices) {
    devices_.push_back(std::make_shared<Playing>(Playing{std::move(device), now_s, {}}));
  }
}

FixturePlayer::~FixturePlayer() = default;

std::vector<HidDeviceInfo> FixturePlayer::enumerate() {
  std::vector<HidDeviceInfo> found;
  for (const auto& playing : devices_) {
    if (const Playing::Situation now = playing->situation(); now.present) {
      found.push_back(playing->device.info);
      found.back().path = now.path;
    }
  }
  return found;
}

HidOpening FixturePlayer::open_path(const std::string& path) {
  for (const auto& playing : devices_) {
    const Playing::Situation now = playing->situation();
    if (!now.present || now.path != path) {
      continue;
    }
    if (!now.allowed) {
      return {nullptr, true, "Permission denied"};
    }
    return {std::make_unique<Handle>(playing, playing->first_from(playing->now_s())), false, ""};
  }
  return {nullptr, false, "No such device"};
}

std::uint64_t FixturePlayer::change_mark() {
  std::uint64_t mark = 1;
  for (const auto& playing : devices_) {
    mark += playing->situation().changes;
  }
  return mark;
}

const std::vector<std::vector<std::uint8_t>>& FixturePlayer::sent_to(std::size_t device) const {
  return devices_.at(device)->sent;
}

std::unique_ptr<HidApi> play_hid_fixture(const std::filesystem::path& path) {
  const auto start = std::chrono::steady_clock::now();
  return std::make_unique<FixturePlayer>(load_hid_fixture(path), [start] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  });
}

}  // namespace ergodome
