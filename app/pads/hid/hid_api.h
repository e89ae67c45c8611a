#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace ergodome {

enum class HidBus { usb, bluetooth, other };

//! A usage of a device's collections: page and number, as 1:5 for a game pad.
struct HidUsage {
  std::uint16_t page = 0;
  std::uint16_t usage = 0;

  bool operator==(const HidUsage&) const = default;
};

//! A device that is there, whether it may be opened or not.
struct HidDeviceInfo {
  std::string path;
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;
  std::string name;
  std::string serial;  //!< empty where there is none
  HidBus bus = HidBus::other;
  std::vector<HidUsage> usages;  //!< of its collections; empty where the system does not tell
};

//! An open device.
class HidDevice {
 public:
  HidDevice() = default;
  HidDevice(const HidDevice&) = delete;
  HidDevice& operator=(const HidDevice&) = delete;
  virtual ~HidDevice() = default;

  //! One input report, beginning with its id where the device has ids: its bytes, cut at the end of `into`; 0 where none came in that
  //! time; -1 where the device is gone.
  virtual int read_timeout(std::span<std::uint8_t> into, int milliseconds) = 0;
  //! An output report, beginning with its id; false where it did not go.
  virtual bool write(std::span<const std::uint8_t> report) = 0;
  //! A feature report, beginning with its id; false where it did not go.
  virtual bool send_feature(std::span<const std::uint8_t> report) = 0;
  //! Asks for the feature report whose id is report[0]: its bytes; -1 where there is none.
  virtual int get_feature(std::span<std::uint8_t> report) = 0;
  //! The report descriptor; empty where it cannot be had.
  virtual std::vector<std::uint8_t> descriptor() = 0;
};

//! What came of opening a device.
struct HidOpening {
  std::unique_ptr<HidDevice> device;  //!< empty where it could not be opened
  bool denied = false;                //!< for want of permission
  std::string problem;
};

//! The part of hidapi that is used, so that recorded reports can take its place.
class HidApi {
 public:
  HidApi() = default;
  HidApi(const HidApi&) = delete;
  HidApi& operator=(const HidApi&) = delete;
  virtual ~HidApi() = default;

  //! Must come first. What went wrong; empty: nothing.
  virtual std::string init() = 0;
  //! All devices, each once.
  virtual std::vector<HidDeviceInfo> enumerate() = 0;
  virtual HidOpening open_path(const std::string& path) = 0;
  //! A number that changes when devices come, go or change their permissions, much cheaper than enumerate(); 0: not known.
  virtual std::uint64_t change_mark() = 0;
};

//! hidapi itself (Linux: hidraw).
std::unique_ptr<HidApi> make_hid_library();

}  // namespace ergodome
