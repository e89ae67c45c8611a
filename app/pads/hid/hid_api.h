#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace ergodome {

//! Kinds of connections of a HID device.
enum class HidBus { usb, bluetooth, other };

//! A usage of a device's collections: page and number, such as 1:5 for a game pad.
struct HidUsage {
  std::uint16_t page = 0;
  std::uint16_t usage = 0;

  bool operator==(const HidUsage&) const = default;
};

//! A connected device, which the user may lack permission to open.
struct HidDeviceInfo {
  std::string path;
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;
  std::string name;
  std::string serial;  //!< serial number; empty if there is none
  HidBus bus = HidBus::other;
  //! Usages of the device's collections; empty if the system does not report them.
  std::vector<HidUsage> usages;
};

//! An open device.
class HidDevice {
 public:
  HidDevice() = default;
  HidDevice(const HidDevice&) = delete;
  HidDevice& operator=(const HidDevice&) = delete;
  virtual ~HidDevice() = default;

  //! Reads an input report, starting with its id if the device has ids, truncated to the size of
  //! `into`. Returns its size, 0 on timeout, and -1 if the device is gone.
  virtual int read_timeout(std::span<std::uint8_t> into, int milliseconds) = 0;
  //! Sends an output report, starting with its id. Returns false on failure.
  virtual bool write(std::span<const std::uint8_t> report) = 0;
  //! Sends a feature report, starting with its id. Returns false on failure.
  virtual bool send_feature(std::span<const std::uint8_t> report) = 0;
  //! Requests the feature report with the id report[0]. Returns its size; -1 if there is none.
  virtual int get_feature(std::span<std::uint8_t> report) = 0;
  //! Returns the report descriptor; empty if it is not available.
  virtual std::vector<std::uint8_t> descriptor() = 0;
};

//! Result of opening a device.
struct HidOpening {
  std::unique_ptr<HidDevice> device;  //!< null on failure
  bool denied = false;                //!< failed because of missing permissions
  std::string problem;
};

//! Interface to the used part of hidapi, so that recorded reports can replace it.
class HidApi {
 public:
  HidApi() = default;
  HidApi(const HidApi&) = delete;
  HidApi& operator=(const HidApi&) = delete;
  virtual ~HidApi() = default;

  //! Initializes the library; call it first. Returns the problem; empty on success.
  virtual std::string init() = 0;
  //! Returns all devices, each once.
  virtual std::vector<HidDeviceInfo> enumerate() = 0;
  virtual HidOpening open_path(const std::string& path) = 0;
  //! Returns a number that changes when devices come, go or change their permissions; 0 if unknown.
  //! Much faster than enumerate().
  virtual std::uint64_t change_mark() = 0;
};

//! Makes the implementation by hidapi (Linux: hidraw).
std::unique_ptr<HidApi> make_hid_library();

}  // namespace ergodome
