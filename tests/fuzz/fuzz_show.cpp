#include <cstddef>
#include <cstdint>
#include <string_view>

#include "content/camera_path.h"
#include "content/show_reader.h"
#include "kernels/core/error.h"

// Any text is either a show, which then reads back from its own text, or an Error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const ergodome::Show show = ergodome::parse_show({reinterpret_cast<const char*>(data), size}, "fuzz.toml");
    ergodome::camera_pose(show, 0.5 * show.duration_s);
    ergodome::to_toml(show);
  } catch (const ergodome::Error&) {
  }
  return 0;
}
