#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "app/pads/decoders/pad_decoder.h"
#include "app/pads/pad_response.h"

// The first byte chooses a pad and its bus. The rest contains reports, each preceded by its length
// in one byte; 0 means that the length follows in two bytes. A report must not make a decoder read
// beyond the end of the report or set an axis outside its range.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  struct Kind {
    std::uint16_t vendor;
    std::uint16_t product;
  };
  constexpr std::array kinds = std::to_array<Kind>({{0x054C, 0x05C4},
                                                    {0x054C, 0x0CE6},
                                                    {0x045E, 0x02E0},
                                                    {0x045E, 0x0B13},
                                                    {0x057E, 0x2009},
                                                    {0x046D, 0xC216},
                                                    {0x046D, 0xC626},
                                                    {0x2DC8, 0x6003}});
  if (size == 0) {
    return 0;
  }
  ergodome::HidDeviceInfo info;
  info.vendor = kinds[(data[0] & 0x7fU) % kinds.size()].vendor;
  info.product = kinds[(data[0] & 0x7fU) % kinds.size()].product;
  info.bus = (data[0] & 0x80) != 0 ? ergodome::HidBus::bluetooth : ergodome::HidBus::usb;
  const auto decoder = ergodome::make_pad_decoder(info, {});
  ergodome::RawPad pad = ergodome::at_rest(decoder->layout());
  std::span<const std::uint8_t> rest(data + 1, size - 1);
  while (!rest.empty()) {
    std::size_t length = rest[0];
    rest = rest.subspan(1);
    if (length == 0 && rest.size() >= 2) {
      length = rest[0] | (rest[1] << 8U);
      rest = rest.subspan(2);
    }
    length = std::min(length, rest.size());
    const std::vector<std::uint8_t> report(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(length));
    rest = rest.subspan(length);
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
