#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "app/pads/pad_settings.h"
#include "kernels/core/error.h"

// Any text is either settings that survive a round trip through their text, or throws an Error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ergodome::PadSettings settings;
  try {
    settings = ergodome::parse_pad_settings({reinterpret_cast<const char*>(data), size}, "fuzz.toml");
  } catch (const ergodome::Error&) {
    return 0;
  }
  if (ergodome::parse_pad_settings(ergodome::to_toml(settings), "again.toml") != settings) {
    __builtin_trap();
  }
  return 0;
}
