#include "render/patterns/dome_label.h"

#include <algorithm>
#include <cmath>

#include "kernels/core/angles.h"

namespace ergodome {

namespace {

constexpr int font_px = 48;

}  // namespace

LabelStamp::LabelStamp(const DomeLabel& label) : text_(text_image(label.text, font_px)), colour_(label.colour) {
  const double azimuth = label.azimuth_deg * one_degree;
  const double elevation = label.elevation_deg * one_degree;
  const Vector3<double> ahead = {std::sin(azimuth), 0.0, -std::cos(azimuth)};
  middle_ = std::cos(elevation) * ahead + Vector3<double>{0.0, std::sin(elevation), 0.0};
  right_ = {std::cos(azimuth), 0.0, std::sin(azimuth)};
  up_ = cross(right_, middle_);
  // Capital letters fill the label's height.
  scale_ = std::max(text_.height, 1) / (label.height_deg * one_degree);
  cosine_beyond_ = std::cos(std::atan(0.5 * std::hypot(text_.width, text_.height) / scale_));
}

float LabelStamp::coverage(const Vector3<double>& n) const {
  const double ahead = dot(n, middle_);
  if (!(ahead > cosine_beyond_)) {
    return 0.0F;
  }
  const double x = 0.5 * text_.width + scale_ * dot(n, right_) / ahead - 0.5;
  const double y = 0.5 * text_.height - scale_ * dot(n, up_) / ahead - 0.5;
  const int column = static_cast<int>(std::floor(x));
  const int row = static_cast<int>(std::floor(y));
  const auto at = [&](int i, int j) {
    const bool inside = i >= 0 && j >= 0 && i < text_.width && j < text_.height;
    return inside ? text_.coverage[static_cast<std::size_t>(j) * static_cast<std::size_t>(text_.width) +
                                   static_cast<std::size_t>(i)]
                  : 0.0F;
  };
  const auto across = static_cast<float>(x - column);
  const auto down = static_cast<float>(y - row);
  return (1.0F - down) * ((1.0F - across) * at(column, row) + across * at(column + 1, row)) +
         down * ((1.0F - across) * at(column, row + 1) + across * at(column + 1, row + 1));
}

std::vector<LabelStamp> stamps_of(const std::vector<DomeLabel>& labels) { return {labels.begin(), labels.end()}; }

Vector3<float> labelled(Vector3<float> light, const std::vector<LabelStamp>& stamps, const Vector3<double>& n) {
  for (const LabelStamp& stamp : stamps) {
    const float part = stamp.coverage(n);
    light = (1.0F - part) * light + part * stamp.colour();
  }
  return light;
}

}  // namespace ergodome
