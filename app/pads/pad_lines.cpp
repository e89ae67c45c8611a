#include "app/pads/pad_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "app/pads/state/pad_names.h"
#include "content/files/printable.h"

namespace ergodome {

std::string live_line(const PadView& pad) {
  const PadIdentity& pad_identity = *pad.identity;
  if (!pad.problem.empty()) {
    return fmt::format("- {} ({}): {}", pad_identity.name, pad_identity.connection, pad.problem);
  }
  std::string line = fmt::format("{} {} ({}):", pad.number, pad_identity.name, pad_identity.connection);
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
