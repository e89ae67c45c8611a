#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "calibration/dome/dome_setup.h"
#include "kernels/core/error.h"

// Any text is either a setup that survives a round trip through its text, or throws an Error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using ergodome::NamedFiles;
  std::string text;
  try {
    text = ergodome::to_toml(
        ergodome::parse_dome_setup({reinterpret_cast<const char*>(data), size}, "fuzz.toml", NamedFiles::unchecked));
  } catch (const ergodome::Error&) {
    return 0;
  }
  ergodome::parse_dome_setup(text, "again.toml", NamedFiles::unchecked);
  return 0;
}
