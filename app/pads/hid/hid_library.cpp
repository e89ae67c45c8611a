#include <hidapi.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>

#include "app/pads/hid/hid_api.h"
#include "app/pads/hid/hid_text.h"

namespace ergodome {

namespace {

namespace fs = std::filesystem;

constexpr std::streamsize longest_own_descriptor = 4096;

HidBus bus_of(hid_bus_type bus) {
  switch (bus) {
    case HID_API_BUS_USB:
      return HidBus::usb;
    case HID_API_BUS_BLUETOOTH:
      return HidBus::bluetooth;
    default:
      return HidBus::other;
  }
}

//! Reads the descriptor from sysfs, because hidapi 0.13 has no call for it:
//! /sys/class/hidraw/hidraw3/device/report_descriptor.
std::vector<std::uint8_t> descriptor_of(const std::string& path) {
  const fs::path node = fs::path("/sys/class/hidraw") / fs::path(path).filename() / "device" / "report_descriptor";
  std::ifstream file(node, std::ios::binary);
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(longest_own_descriptor));
  file.read(reinterpret_cast<char*>(bytes.data()), longest_own_descriptor);
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

class LibraryDevice : public HidDevice {
 public:
  LibraryDevice(hid_device* device, std::string path) : device_(device), path_(std::move(path)) {}
  ~LibraryDevice() override { hid_close(device_); }

  int read_timeout(std::span<std::uint8_t> into, int milliseconds) override {
    return hid_read_timeout(device_, into.data(), into.size(), milliseconds);
  }
  bool write(std::span<const std::uint8_t> report) override {
    return hid_write(device_, report.data(), report.size()) == static_cast<int>(report.size());
  }
  bool send_feature(std::span<const std::uint8_t> report) override {
    return hid_send_feature_report(device_, report.data(), report.size()) == static_cast<int>(report.size());
  }
  int get_feature(std::span<std::uint8_t> report) override {
    return hid_get_feature_report(device_, report.data(), report.size());
  }
  std::vector<std::uint8_t> descriptor() override { return descriptor_of(path_); }

 private:
  hid_device* device_;
  std::string path_;
};

class Library : public HidApi {
 public:
  ~Library() override { hid_exit(); }

  std::string init() override { return hid_init() == 0 ? "" : "the library hidapi cannot be initialized"; }

  std::vector<HidDeviceInfo> enumerate() override {
    std::vector<HidDeviceInfo> found;
    hid_device_info* const list = hid_enumerate(0, 0);
    for (const hid_device_info* at = list; at != nullptr; at = at->next) {
      if (at->path != nullptr) {
        merge(found, *at);
      }
    }
    hid_free_enumeration(list);
    return found;
  }

  HidOpening open_path(const std::string& path) override {
    if (hid_device* const device = hid_open_path(path.c_str()); device != nullptr) {
      return {std::make_unique<LibraryDevice>(device, path), false, ""};
    }
    const bool denied = ::access(path.c_str(), R_OK | W_OK) != 0 && (errno == EACCES || errno == EPERM);
    return {nullptr, denied, text_of(hid_error(nullptr))};
  }

  std::uint64_t change_mark() override {
    std::uint64_t mark = 1;
    std::error_code problem;
    for (const auto& entry : fs::directory_iterator("/sys/class/hidraw", problem)) {
      struct stat node {};
      const std::string name = entry.path().filename().string();
      if (::stat(("/dev/" + name).c_str(), &node) == 0) {
        const auto changed = static_cast<std::uint64_t>(node.st_ctim.tv_sec) * 1'000'000'000U +
                             static_cast<std::uint64_t>(node.st_ctim.tv_nsec);
        mark += std::hash<std::string>{}(name) ^ (changed * 0x9e3779b97f4a7c15U);
      }
    }
    return problem ? 0 : std::max<std::uint64_t>(mark, 1);
  }

 private:
  //! Adds a device or its usage; hidapi lists a device once per usage.
  static void merge(std::vector<HidDeviceInfo>& found, const hid_device_info& at) {
    auto known =
        std::find_if(found.begin(), found.end(), [&](const HidDeviceInfo& info) { return info.path == at.path; });
    if (known == found.end()) {
      found.push_back({at.path,
                       at.vendor_id,
                       at.product_id,
                       text_of(at.product_string),
                       text_of(at.serial_number),
                       bus_of(at.bus_type),
                       {}});
      known = std::prev(found.end());
    }
    if (at.usage_page != 0) {
      known->usages.push_back({at.usage_page, at.usage});
    }
  }
};

}  // namespace

std::unique_ptr<HidApi> make_hid_library() { return std::make_unique<Library>(); }

}  // namespace ergodome
