#include "calibration/projectors/dome_blend.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/core/error.h"
#include "kernels/launch/parallel_for.h"

namespace ergodome {

namespace {

//! Number of samples per side of each raster from which the light level is determined.
constexpr int samples = 97;
//! Smaller shares are negligible and do not limit the light level.
constexpr double min_part = 1e-3;
//! Mask values of at least this may have been clamped to 1: they are in the last step of 16 bits.
constexpr float cut_off = 0.99998F;

}  // namespace

DomeBlend::DomeBlend(std::vector<ProjectorOptics> projectors, const DomeScreen& screen, const BlendSettings& settings)
    : projectors_(std::move(projectors)), screen_(screen), settings_(settings) {
  double level = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < projectors_.size(); ++i) {
    for (int sample = 0; sample < samples * samples; ++sample) {
      const int row = sample / samples;
      const RasterPosition position = {fill_position(sample - samples * row, samples), fill_position(row, samples)};
      double u = 0.0;
      double v = 0.0;
      const auto point = projectors_[i].dome_point(position);
      if (point && master_position(screen_, *point, u, v)) {
        const double own = part(i, position);
        const double light = evened_light(i, position);
        if (own > min_part && light > 0.0) {
          level = std::min(level, light / own);
        }
      }
    }
  }
  if (!(level < std::numeric_limits<double>::infinity())) {
    throw Error(projectors_.empty() ? "blend" : projectors_.front().location(),
                "lights no part of the dome, and neither does any other projector",
                "check position_m, yaw_deg and pitch_deg; without these angles a projector points to the dome's front");
  }
  level_ = level;
}

double DomeBlend::part(std::size_t projector, const RasterPosition& position) const {
  const auto point = projectors_[projector].dome_point(position);
  const double own = std::pow(projectors_[projector].depth(position), settings_.softness);
  if (!point || !(own > 0.0)) {
    return 0.0;
  }
  double sum = own;
  for (std::size_t i = 0; i < projectors_.size(); ++i) {
    if (i != projector) {
      const auto there = projectors_[i].raster_position(*point);
      sum += there ? std::pow(projectors_[i].depth(*there), settings_.softness) : 0.0;
    }
  }
  return own / sum;
}

double DomeBlend::evened_light(std::size_t projector, const RasterPosition& position) const {
  const double spread = projectors_[projector].spread_m2(position);
  return spread > 0.0 ? std::pow(1.0 / spread, settings_.evenness) : 0.0;
}

double DomeBlend::intensity(std::size_t projector, const RasterPosition& position) const {
  const double own = part(projector, position);
  const double light = own > 0.0 ? evened_light(projector, position) : 0.0;
  return light > 0.0 ? std::min(own * level_ / light, 1.0) : 0.0;
}

BlendMap DomeBlend::mask(std::size_t projector, int width_px, int height_px) const {
  BlendMap map;
  map.width = width_px;
  map.height = height_px;
  map.bit_depth = 16;
  map.values.resize(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px));
  parallel_for(height_px, 4, [&](int begin, int end) {
    for (int row = begin; row < end; ++row) {
      for (int column = 0; column < width_px; ++column) {
        const RasterPosition position = {fill_position(column, width_px), fill_position(row, height_px)};
        map.values[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_px) +
                   static_cast<std::size_t>(column)] = static_cast<float>(intensity(projector, position));
      }
    }
  });
  return map;
}

BlendMap DomeBlend::mask_after_tilt(std::size_t projector, const BlendMap& mask, const DomeBlend& before) const {
  BlendMap map = mask;
  const auto factor = static_cast<float>(level_ / before.level_);
  parallel_for(map.height, 4, [&](int begin, int end) {
    for (int row = begin; row < end; ++row) {
      for (int column = 0; column < map.width; ++column) {
        float& value = map.values[static_cast<std::size_t>(row) * static_cast<std::size_t>(map.width) +
                                  static_cast<std::size_t>(column)];
        if (value < cut_off) {
          value = std::min(value * factor, 1.0F);
          continue;
        }
        const RasterPosition position = {fill_position(column, map.width), fill_position(row, map.height)};
        const auto point = projectors_[projector].dome_point(position);
        double u = 0.0;
        double v = 0.0;
        if (point && master_position_near_rim(screen_, *point, u, v)) {
          value = static_cast<float>(intensity(projector, position));
        }
      }
    }
  });
  return map;
}

}  // namespace ergodome
