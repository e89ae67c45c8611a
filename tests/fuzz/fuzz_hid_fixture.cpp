#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "app/pads/hid/hid_fixture.h"
#include "kernels/core/error.h"

// Any text is either the recording of a pad that can be played, or throws an Error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    double now_s = 0.0;
    ergodome::FixturePlayer player(
        ergodome::parse_hid_fixture({reinterpret_cast<const char*>(data), size}, "fuzz.toml"), [&] { return now_s; });
    for (const double step_s : {0.0, 0.5, 100.0}) {
      now_s += step_s;
      for (const ergodome::HidDeviceInfo& info : player.enumerate()) {
        const ergodome::HidOpening opening = player.open_path(info.path);
        std::array<std::uint8_t, 64> report{};
        for (int i = 0; opening.device != nullptr && i < 100 && opening.device->read_timeout(report, 0) > 0; ++i) {
        }
      }
    }
  } catch (const ergodome::Error&) {
  }
  return 0;
}
