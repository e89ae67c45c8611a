#include "app/pads/decoders/pad_decoder.h"

#include <algorithm>
#include <array>

#include "app/pads/decoders/decoders.h"
#include "app/pads/decoders/generic_mapping.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

enum class Model { dualshock4, dualsense, xbox, xbox_share, switch_pro, f310, space_mouse, eight_bit_do };

struct Known {
  std::uint16_t vendor;
  std::uint16_t product;
  Model model;
};

constexpr std::array known_pads = std::to_array<Known>({
    {0x054C, 0x05C4, Model::dualshock4},
    {0x054C, 0x09CC, Model::dualshock4},
    {0x054C, 0x0BA0, Model::dualshock4},  // wireless receiver
    {0x054C, 0x0CE6, Model::dualsense},
    {0x054C, 0x0DF2, Model::dualsense},  // Edge
    {0x045E, 0x02E0, Model::xbox},       // One S
    {0x045E, 0x02FD, Model::xbox},
    {0x045E, 0x0B20, Model::xbox},
    {0x045E, 0x0B05, Model::xbox},  // Elite 2
    {0x045E, 0x0B22, Model::xbox},
    {0x045E, 0x0B0C, Model::xbox},  // Adaptive
    {0x045E, 0x0B21, Model::xbox},
    {0x045E, 0x0B13, Model::xbox_share},  // Series X|S
    {0x057E, 0x2009, Model::switch_pro},
    {0x046D, 0xC216, Model::f310},
    // Pilot; then Navigator, Explorer, Navigator for notebooks, Pilot Pro, Pro.
    {0x046D, 0xC625, Model::space_mouse},
    {0x046D, 0xC626, Model::space_mouse},
    {0x046D, 0xC627, Model::space_mouse},
    {0x046D, 0xC628, Model::space_mouse},
    {0x046D, 0xC629, Model::space_mouse},
    {0x046D, 0xC62B, Model::space_mouse},
    {0x256F, 0xC62E, Model::space_mouse},  // Wireless
    {0x256F, 0xC62F, Model::space_mouse},
    {0x256F, 0xC63A, Model::space_mouse},
    {0x256F, 0xC631, Model::space_mouse},  // Pro Wireless
    {0x256F, 0xC632, Model::space_mouse},
    {0x256F, 0xC638, Model::space_mouse},
    {0x256F, 0xC633, Model::space_mouse},  // Enterprise
    {0x256F, 0xC635, Model::space_mouse},  // Compact
    {0x256F, 0xC636, Model::space_mouse},  // Module
    {0x256F, 0xC652, Model::space_mouse},  // universal receiver
    // SF30 Pro, SN30 Pro, Pro 2, Pro 3, Ultimate 2 Wireless, Ultimate 3.
    {0x2DC8, 0x6000, Model::eight_bit_do},
    {0x2DC8, 0x6100, Model::eight_bit_do},
    {0x2DC8, 0x6001, Model::eight_bit_do},
    {0x2DC8, 0x6101, Model::eight_bit_do},
    {0x2DC8, 0x6003, Model::eight_bit_do},
    {0x2DC8, 0x6006, Model::eight_bit_do},
    {0x2DC8, 0x6009, Model::eight_bit_do},
    {0x2DC8, 0x6012, Model::eight_bit_do},
    {0x2DC8, 0x202F, Model::eight_bit_do},
});

const Known* known_of(const HidDeviceInfo& info) {
  const auto* const found = std::find_if(known_pads.begin(), known_pads.end(), [&](const Known& known) {
    return known.vendor == info.vendor && known.product == info.product;
  });
  return found == known_pads.end() ? nullptr : found;
}

//! Makes a decoder from the descriptor; null if that is malformed or not of a controller.
std::unique_ptr<PadDecoder> by_descriptor(std::span<const std::uint8_t> descriptor) {
  try {
    return make_by_descriptor(descriptor);
  } catch (const Error&) {
    return nullptr;
  }
}

std::unique_ptr<PadDecoder> make_known(Model model, HidBus bus, std::span<const std::uint8_t> descriptor) {
  switch (model) {
    case Model::dualshock4:
      return make_dualshock4(bus);
    case Model::dualsense:
      return make_dualsense(bus);
    case Model::xbox:
      return make_xbox_bluetooth(false);
    case Model::xbox_share:
      return make_xbox_bluetooth(true);
    case Model::switch_pro:
      return make_switch_pro(bus);
    case Model::f310:
      return make_logitech_f310();
    case Model::space_mouse:
      return make_space_mouse();
    case Model::eight_bit_do:
      return make_8bitdo(by_descriptor(descriptor));
  }
  return nullptr;
}

}  // namespace

RawPad at_rest(const RawLayout& layout) {
  RawPad pad;
  for (std::size_t i = 0; i < std::min(layout.axes.size(), max_raw_axes); ++i) {
    pad.values[i] = layout.axes[i].centre;
  }
  return pad;
}

bool is_pad(const HidDeviceInfo& info) {
  // Other interfaces of a known device (keyboards of larger 3D mice, receivers) are not
  // controllers.
  return info.usages.empty() ? known_of(info) != nullptr
                             : std::any_of(info.usages.begin(), info.usages.end(), is_pad_usage);
}

std::unique_ptr<PadDecoder> make_pad_decoder(const HidDeviceInfo& info, std::span<const std::uint8_t> descriptor) {
  if (!is_pad(info)) {
    return nullptr;
  }
  const Known* const known = known_of(info);
  return known != nullptr ? make_known(known->model, info.bus, descriptor) : by_descriptor(descriptor);
}

}  // namespace ergodome
