#include <cstddef>
#include <cstdint>
#include <string_view>

#include "app/remote/common/command_rules.h"
#include "app/remote/web/web_json.h"
#include "kernels/core/error.h"

namespace {

ergodome::PlayerStatus show_with_chapters() {
  ergodome::PlayerStatus status;
  status.chapters = {{0.0, "one", {"one", "eins"}}, {1.0, "two", {"two", "zwei"}}};
  return status;
}

}  // namespace

// Any accepted JSON command has finite numbers.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const ergodome::PlayerStatus status = show_with_chapters();
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const ergodome::TransportCommand command = ergodome::parse_json_command(text, status);
    if (!(command.value >= -ergodome::max_show_time_s && command.value <= ergodome::max_show_time_s)) {
      __builtin_trap();
    }
  } catch (const ergodome::Error&) {
  }
  return 0;
}
