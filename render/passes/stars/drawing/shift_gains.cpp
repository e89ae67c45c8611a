#include "render/passes/stars/drawing/shift_gains.h"

#include <algorithm>
#include <cmath>

namespace ergodome {

namespace {

//! The rows of the table are at equal steps of ln g, where g is the frequency ratio. Over one step
//! near g = 1, stars of 6,000 K become brighter by a tenth and the coldest stars by a third. The
//! bound of the first row holds for all smaller g; patches have no g above 10⁶.
constexpr float log_first = -4.0F;
constexpr float log_step = 0.02F;
constexpr int shifted_rows = 901;

//! Returns ln of the factor by which a frequency shift changes the luminance of a blackbody.
float log_gain(const BlackbodyTable& colours, float log_temperature, float log_ratio) {
  return read_blackbody(colours, log_temperature + log_ratio).x - read_blackbody(colours, log_temperature).x;
}

}  // namespace

int ShiftGains::unshifted_row() { return shifted_rows; }

int ShiftGains::row_of(float frequency_ratio) {
  const float position = std::ceil((std::log(std::max(frequency_ratio, 1e-30F)) - log_first) / log_step);
  return static_cast<int>(std::clamp(position, 0.0F, static_cast<float>(shifted_rows - 1)));
}

ShiftGains::ShiftGains(const BlackbodyTable& colours) : rows_(shifted_rows + 1) {
  for (int i = 0; i < shifted_rows; ++i) {
    ShiftGain& row = rows_[static_cast<std::size_t>(i)];
    const float log_ratio = log_first + log_step * static_cast<float>(i);
    for (int k = 0; k < star_classes; ++k) {
      // The gain is monotonic in temperature, so its maximum lies at an end of the class.
      const float low = log_coldest_class + star_class_width * static_cast<float>(k);
      const float gain =
          std::max(log_gain(colours, low, log_ratio), log_gain(colours, low + star_class_width, log_ratio));
      row.log_gain[static_cast<std::size_t>(k)] = gain;
      row.gain[static_cast<std::size_t>(k)] = std::exp(gain);
    }
  }
  std::ranges::fill(rows_.back().gain, 1.0F);
  std::ranges::fill(rows_.back().log_gain, 0.0F);
}

}  // namespace ergodome
