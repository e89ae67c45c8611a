#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string_view>

#include "app/pads/hid/hid_api.h"

namespace ergodome {

//! An event of a device in a fixture.
struct HidEvent {
  double t_s = 0.0;
  enum class Kind { report, disconnect, connect, error, deny, allow } kind = Kind::report;
  std::vector<std::uint8_t> bytes;  //!< bytes of the report, for `report`
  std::string path;                 //!< for `connect`: the new path of the device; empty: unchanged
  std::string expect;               //!< for tests: the expected state of the controller
};

struct FixtureDevice {
  HidDeviceInfo info;
  std::vector<std::uint8_t> descriptor;
  bool present = true;
  bool allowed = true;
  double repeat_s = 0.0;  //!< period of the timeline; 0: it plays once
  std::vector<HidEvent> timeline;
  //! Answers to get_feature, starting with their ids.
  std::vector<std::vector<std::uint8_t>> features;
};

//! Recorded or synthetic reports of devices, with their times.
struct HidFixture {
  std::string source;  //!< where the bytes of the fixture come from
  std::vector<FixtureDevice> devices;
};

//! Parses a fixture (tests/data/hid/README.md describes the format). Throws Error with file and
//! line.
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

  //! Returns the output and feature reports sent to a device, and the ids of requested feature
  //! reports, in order.
  [[nodiscard]] const std::vector<std::vector<std::uint8_t>>& sent_to(std::size_t device) const;

 private:
  class Handle;
  struct Playing;
  std::vector<std::shared_ptr<Playing>> devices_;
};

//! Plays a fixture from a file, starting now.
std::unique_ptr<HidApi> play_hid_fixture(const std::filesystem::path& path);

}  // namespace ergodome
