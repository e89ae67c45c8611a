#include "app/commands/pad_listing.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "app/pads/decoders/pad_decoder.h"
#include "app/pads/pad_hub.h"
#include "app/pads/state/pad_names.h"
#include "content/files/console.h"
#include "content/files/printable.h"

namespace ergodome {

namespace {

std::string profile_name(const PadSettings& settings, const PadIdentity& pad) {
  const PadProfile& profile = profile_for(settings, pad);
  return &profile == &settings.otherwise ? "[default]" : fmt::format("[[pad]] {}", &profile - settings.pads.data() + 1);
}

//! Returns the decoder of a device, or why it cannot be used.
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

std::string live_line(const PadView& pad) {
  const PadIdentity& who = *pad.identity;
  if (!pad.problem.empty()) {
    return fmt::format("- {} ({}): {}", who.name, who.connection, pad.problem);
  }
  std::string line = fmt::format("{} {} ({}):", pad.number, who.name, who.connection);
  if (!pad.connected) {
    return line + " unplugged";
  }
  // Adding zero turns negative zero, of a stick at rest just below its center, into positive zero.
  const auto axis = [&](PadAxis which) { return pad.state.axis(which) + 0.0F; };
  fmt::format_to(std::back_inserter(line), " left {:+.2f} {:+.2f}  right {:+.2f} {:+.2f}  triggers {:.2f} {:.2f}",
                 axis(PadAxis::left_x), axis(PadAxis::left_y), axis(PadAxis::right_x), axis(PadAxis::right_y),
                 axis(PadAxis::left_trigger), axis(PadAxis::right_trigger));
  const auto* const puck = pad.state.axes.begin() + static_cast<std::ptrdiff_t>(PadAxis::move_right);
  if (std::any_of(puck, pad.state.axes.end(), [](float value) { return value != 0.0F; })) {
    fmt::format_to(std::back_inserter(line), "  puck {:+.2f} {:+.2f} {:+.2f}  turned {:+.2f} {:+.2f} {:+.2f}",
                   axis(PadAxis::move_right), axis(PadAxis::move_up), axis(PadAxis::move_forward),
                   axis(PadAxis::turn_pitch), axis(PadAxis::turn_yaw), axis(PadAxis::turn_roll));
  }
  for (std::size_t i = 0; i < pad_button_count; ++i) {
    if (pad.state.buttons[i]) {
      fmt::format_to(std::back_inserter(line), "  {}", name_of(static_cast<PadButton>(i)));
    }
  }
  if (pad.absent) {
    line += "  (receiver without a pad)";
  }
  if (pad.stuck) {
    line += "  (a stuck axis is ignored)";
  }
  if (pad.refused > 0) {
    fmt::format_to(std::back_inserter(line), "  ({} of {} not understood)", pad.refused,
                   counted(pad.reports, "HID report"));
  }
  return line;
}

}  // namespace ergodome
