#include <cstddef>
#include <cstdint>
#include <string>

#include "render/passes/overlay/caption_image.h"

// The first byte chooses the width at which the lines of a caption are broken; the rest is its
// text.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) {
    return 0;
  }
  const std::string text(data + 1, data + size);
  ergodome::set_caption(text, {8, 4.0 * data[0]});
  return 0;
}
