#include "content/images/light_coding.h"

#include <algorithm>

#include "kernels/image/color_map.h"

namespace ergodome {

float LightCoding::alpha_of(const float* pixel) const {
  return alpha >= 0 ? std::clamp(pixel[alpha], 0.0F, 1.0F) : 1.0F;
}

int LightCoding::light_channels() const {
  const int colours = channels >= 3 ? 3 : 1;
  return decoded || separate ? std::max(colours, alpha + 1) : colours;
}

void LightCoding::put_light(const float* pixel, float* rgb) const {
  const float part = decoded || separate ? alpha_of(pixel) : 1.0F;
  const bool grey = channels < 3;
  for (int c = 0; c < 3; ++c) {
    float value = pixel[grey ? 0 : c];
    if (decoded) {
      const float colour = separate || part <= 0.0F ? value : value / part;
      value = srgb_decoded(colour) * part;
    } else if (separate) {
      value *= part;
    }
    rgb[c] = value;
  }
}

LightCoding light_coding(const ImageShape& shape) {
  return {shape.channels, shape.alpha_channel, shape.encoded, shape.separate_alpha};
}

}  // namespace ergodome
