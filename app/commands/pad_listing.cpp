#include "app/commands/pad_listing.h"

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "app/pads/decoders/pad_decoder.h"
#include "app/pads/pad_hub.h"
#include "content/files/console.h"
#include "content/files/printable.h"

namespace ergodome {

namespace {

std::string profile_name(const PadSettings& settings, const PadIdentity& pad) {
  const PadProfile& profile = profile_for(settings, pad);
  return &profile == &settings.otherwise ? "[default]" : fmt::format("[[pad]] {}", &profile - settings.pads.data() + 1);
}

//! Returns a text that names the decoder of a device, or says why it cannot be used.
std::string reader_of(HidApi& api, const HidDeviceInfo& info) {
  HidOpening opening = api.open_path(info.path);
  if (opening.device == nullptr) {
    return opening.denied ? permission_remedy(info) : opening.problem;
  }
  const auto decoder = make_pad_decoder(info, opening.device->descriptor());
  return decoder == nullptr ? "not usable: its report descriptor defines no axes or buttons that can be read"
                            : fmt::format("read as {}", decoder->model());
}

}  // namespace

void list_pads(HidApi& api, const PadSettings& settings, const std::filesystem::path& file) {
  int count = 0;
  for (const HidDeviceInfo& info : api.enumerate()) {
    if (!is_pad(info)) {
      continue;
    }
    const PadIdentity pad = identity_of(info, "");
    print_out("{}  {}  {}  {}{}\n   {}\n   settings: {}{}\n", pad.name, device_id(info.vendor, info.product),
              pad.connection, info.path, info.serial.empty() ? "" : fmt::format("  serial {}", info.serial),
              reader_of(api, info), profile_name(settings, pad), profile_for(settings, pad).ignore ? ", ignored" : "");
    ++count;
  }
  if (count == 0) {
    print_out("no controllers found. Microsoft pads work over Bluetooth only, Logitech pads with their switch at D.\n");
  }
  if (file.empty()) {
    print_out("no settings file found, default settings apply; --calibrate creates one\n");
  } else {
    print_out("settings file: {}\n", file.string());
  }
}

void write_pads_found(HidApi& api, PadSettings settings, const std::filesystem::path& out) {
  for (const HidDeviceInfo& info : api.enumerate()) {
    const PadIdentity pad = identity_of(info, "");
    if (is_pad(info) && &profile_for(settings, pad) == &settings.otherwise) {
      PadProfile profile = settings.otherwise;
      profile.device = device_id(info.vendor, info.product);
      profile.serial = info.serial;
      settings.pads.push_back(std::move(profile));
    }
  }
  write_pad_settings(out, settings);
  print_out("settings of {1} written to {0}\n", out.string(), counted(settings.pads.size(), "controller"));
}

}  // namespace ergodome
