#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "app/pads/decoders/decoders.h"
#include "app/pads/pad_response.h"
#include "kernels/core/error.h"

// The input contains the length of an HID descriptor in two bytes, the descriptor, and reports,
// each preceded by its length. A descriptor may throw an Error. If it does not, any report must
// decode to numbers within their range.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) {
    return 0;
  }
  const std::span<const std::uint8_t> input(data + 2, size - 2);
  const std::size_t length = std::min<std::size_t>(data[0] | (data[1] << 8U), input.size());
  std::unique_ptr<ergodome::PadDecoder> decoder;
  try {
    decoder = ergodome::make_by_descriptor(input.first(length));
  } catch (const ergodome::Error&) {
    return 0;
  }
  if (decoder == nullptr) {
    return 0;
  }
  ergodome::RawPad pad = ergodome::at_rest(decoder->layout());
  std::span<const std::uint8_t> rest = input.subspan(length);
  while (!rest.empty()) {
    const std::size_t bytes = std::min<std::size_t>(rest[0], rest.size() - 1);
    const std::vector<std::uint8_t> report(rest.begin() + 1, rest.begin() + 1 + static_cast<std::ptrdiff_t>(bytes));
    rest = rest.subspan(1 + bytes);
    decoder->decode(report, pad);
    const ergodome::PadState state = ergodome::PadResponse(decoder->layout(), {}).apply(pad, {}, {});
    for (const float axis : state.axes) {
      if (!(axis >= -1.001F && axis <= 1.001F)) {
        __builtin_trap();
      }
    }
  }
  return 0;
}
