#include "calibration/formats/mpcdi/mpcdi_light.h"

#include <algorithm>
#include <cmath>

namespace ergodome {

namespace {

double part(const Vector3<double>& v, std::size_t channel) { return channel == 0 ? v.x : channel == 1 ? v.y : v.z; }

//! Returns a channel of a mask at a position of the raster (0 to 1, y down), linear between
//! samples; 1 without a mask.
double channel_at(const BlendMap& mask, double x, double y, std::size_t channel) {
  if (mask.width == 0) {
    return 1.0;
  }
  const double column = std::clamp(x * mask.width - 0.5, 0.0, mask.width - 1.0);
  const double row = std::clamp(y * mask.height - 0.5, 0.0, mask.height - 1.0);
  const int left = std::min(static_cast<int>(column), mask.width - 2);
  const int top = std::min(static_cast<int>(row), mask.height - 2);
  const auto channels = static_cast<std::size_t>(mask.channels);
  const auto sample = [&](int i, int j) -> double {
    const std::size_t at =
        static_cast<std::size_t>(j) * static_cast<std::size_t>(mask.width) + static_cast<std::size_t>(i);
    return mask.values[channels * at + (channels == 3 ? channel : 0)];
  };
  const double across = column - left;
  return std::lerp(std::lerp(sample(left, top), sample(left + 1, top), across),
                   std::lerp(sample(left, top + 1), sample(left + 1, top + 1), across), row - top);
}

}  // namespace

bool has_gain(const Vector3<double>& gain) { return gain.x != 1.0 || gain.y != 1.0 || gain.z != 1.0; }

std::optional<MpcdiMask> beta_of(const BlendMap& black_level, const Vector3<double>& lift,
                                 const Vector3<double>& gain) {
  if (!(lift.x > 0.0 || lift.y > 0.0 || lift.z > 0.0)) {
    return std::nullopt;
  }
  const BlendMap mask = black_level.width > 0 ? black_level : BlendMap{2, 2, 1, 16, std::vector<float>(4, 1.0F)};
  BlendMap beta{mask.width, mask.height, 3, 16, {}};
  beta.values.reserve(3 * mask.values.size() / static_cast<std::size_t>(mask.channels));
  for (std::size_t i = 0; i < mask.values.size(); i += static_cast<std::size_t>(mask.channels)) {
    for (std::size_t c = 0; c < 3; ++c) {
      const float value = mask.values[mask.channels == 3 ? i + c : i];
      beta.values.push_back(static_cast<float>(std::clamp(value * part(lift, c) * part(gain, c), 0.0, 1.0)));
    }
  }
  return MpcdiMask{std::move(beta), 1.0};
}

void put_light(const ProjectorPicture& picture, const BlendMap& intensity, MpcdiRegion& region) {
  region.decode_gamma = 1.0;
  region.encode_gamma = picture.gamma;
  region.beta = beta_of(picture.black_level, picture.black_level_lift, picture.gain);
  const std::size_t channels = has_gain(picture.gain) || picture.blend.channels == 3 ? 3 : 1;
  BlendMap alpha{intensity.width, intensity.height, static_cast<int>(channels), 16, {}};
  alpha.values.reserve(channels * intensity.values.size());
  for (std::size_t i = 0; i < intensity.values.size(); ++i) {
    const auto width = static_cast<std::size_t>(intensity.width);
    const std::size_t row = i / width;
    const double x = (static_cast<double>(i - row * width) + 0.5) / intensity.width;
    const double y = (static_cast<double>(row) + 0.5) / intensity.height;
    for (std::size_t c = 0; c < channels; ++c) {
      const double gain = part(picture.gain, c);
      const double lift = part(picture.black_level_lift, c) * channel_at(picture.black_level, x, y, c);
      const double room = 1.0 - gain * lift;
      const double held = room > 0.0 ? gain * (1.0 - lift) / room : 0.0;
      const double factor = held * intensity.values[i] * channel_at(picture.blend, x, y, c);
      alpha.values.push_back(static_cast<float>(std::clamp(factor, 0.0, 1.0)));
    }
  }
  region.alpha = MpcdiMask{std::move(alpha), 1.0};
}

}  // namespace ergodome
