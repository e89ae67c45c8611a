#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "content/sky/environment_image.h"
#include "kernels/core/error.h"

// The first byte chooses the image format; the rest is the image file. Images wider than 256 px are
// reduced to that width, so that an input needs little memory.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) {
    return 0;
  }
  constexpr const char* names[] = {"fuzz.png", "fuzz.hdr", "fuzz.tif", "fuzz.exr", "fuzz.jpg"};
  try {
    ergodome::read_environment_image(std::as_bytes(std::span(data + 1, size - 1)), names[data[0] % 5], 256);
  } catch (const ergodome::Error&) {
  }
  return 0;
}
