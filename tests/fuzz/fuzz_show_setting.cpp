#include <cstddef>
#include <cstdint>
#include <string>

#include "content/show/reading/show_reader.h"
#include "kernels/core/error.h"

// The input contains one or two settings, as of the option --set. They either change a show or
// throw an Error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const std::size_t end = text.find('\n');
  ergodome::ShowSettings settings = {text.substr(0, end)};
  if (end != std::string::npos) {
    settings.push_back(text.substr(end + 1));
  }
  try {
    ergodome::parse_show(
        "title = \"Evening\"\n[camera]\nobserver = { beta = 0.4, toward = [0, 0, 1] }\n[[camera.key]]\nr = 14\n",
        "fuzz.toml", settings);
  } catch (const ergodome::Error&) {
  }
  return 0;
}
