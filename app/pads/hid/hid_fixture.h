#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string_view>

#include "app/pads/hid/hid_api.h"

namespace ergodome {

//! An event of a device of a fixture.
struct HidEvent {
  double t_s = 0.0;
  enum class Kind { report, disconnect, connect, error, deny, allow } kind = Kind::report;
  std::vector<std::uint8_t> bytes;  //!< of a report
  std::string path;                 //!< of connect: where the device comes back; empty: where it was
  std::string expect;               //!< for tests: what the pad's state is then
};

struct FixtureDevice {
  HidDeviceInfo info;
  std::vector<std::uint8_t> descriptor;
  bool present = true;
  bool allowed = true;
  double repeat_s = 0.0;  //!< period of the timeline; 0: it plays once
  std::vector<HidEvent> timeline;
  std::vector<std::vector<std::uint8_t>> features;  //!< answers to get_feature, beginning with their ids
};

//! Recorded or made-up reports of devices, and when they come.
struct HidFixture {
  std::string source;  //!< where its bytes are from
  std::vector<FixtureDevice> devices;
};

//! Reads a fixture (tests/data/hid/README.md has the format). Throws Error with file and line.
HidFixture parse_hid_fixture(std::string_view text, const std::string& file);
HidFixture load_hid_fixture(const std::filesystem::path& path);

//! Plays a fixture as if its devices were connected; the clock returns seconds since the start.
class FixturePlayer : public HidApi {
 public:
  FixturePlayer(HidFixture fixture, std::function<double()> now_s);
  ~FixturePlayer() override;

  std::string init() override { return ""; }
  std::vector<HidDeviceInfo> enumerate() override;
  HidOpening open_path(const std::string& path) override;
  std::uint64_t change_mark() override;

  //! Output and feature reports that a device was sent, and feature reports it was asked for (their ids alone), in order.
  [[nodiscard]] const std::vector<std::vector<std::uint8_t>>& sent_to(std::size_t device) const;

 private:
  class Handle;
  struct Playing;
  std::vector<std::shared_ptr<Playing>> devices_;
};

//! A fixture from a file, by the time since now.
std::unique_ptr<HidApi> play_hid_fixture(const std::filesystem::path& path);

}  // namespace ergodome
