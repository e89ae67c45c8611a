#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "app/navigation/controls/controls.h"
#include "kernels/core/error.h"

// Any text is either a control map that survives a round trip through its text, or throws an Error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string text;
  try {
    text = to_toml(ergodome::parse_controls({reinterpret_cast<const char*>(data), size}, "fuzz.toml"));
  } catch (const ergodome::Error&) {
    return 0;
  }
  if (to_toml(ergodome::parse_controls(text, "again.toml")) != text) {
    __builtin_trap();
  }
  return 0;
}
