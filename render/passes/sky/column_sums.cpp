#include "render/passes/sky/column_sums.h"

#include <algorithm>
#include <cmath>

#include "kernels/core/angles.h"
#include "kernels/launch/parallel_for.h"
#include "kernels/launch/work_counter.h"

namespace ergodome {

namespace {}  // namespace

ColumnSums::ColumnSums(const EnvironmentImage& image, const TemperatureFit* fit)
    : width_(image.width), height_(image.height), parts_(fit != nullptr ? 4 : 3) {
  const auto rows = static_cast<std::size_t>(height_) + 1;
  for (std::size_t row = 0; row < rows; ++row) {
    sines_.push_back(std::cos(pi * static_cast<double>(row) / height_));
  }
  sums_.resize(static_cast<std::size_t>(parts_) * static_cast<std::size_t>(width_) * rows);
  count_work("buffer: column sums", static_cast<long>(sums_.size() * sizeof(double)));
  parallel_for(width_, 16, [&](int begin, int end) {
    for (int column = begin; column < end; ++column) {
      double* to = sums_.data() + static_cast<std::size_t>(parts_) * static_cast<std::size_t>(column) * rows;
      glm::dvec4 sum(0.0);
      for (std::size_t row = 0; row < rows; ++row, to += parts_) {
        for (int part = 0; part < parts_; ++part) {
          to[part] = sum[part];
        }
        if (row + 1 < rows) {
          const float* texel =
              image.rgb.data() + 3 * (row * static_cast<std::size_t>(width_) + static_cast<std::size_t>(column));
          const glm::vec3 light(texel[0], texel[1], texel[2]);
          const float fourth = fit != nullptr ? fit->weighted_log_temperature(light) : 0.0F;
          sum += (sines_[row] - sines_[row + 1]) * glm::dvec4(light, fourth);
        }
      }
    }
  });
  for (int column = 0; column < width_; ++column) {
    add_at(column, {-1.0, height_ - 1}, 1.0, whole_);
  }
}

long ColumnSums::bytes_for(int map_width, bool fitted) {
  const long rows = map_width / 2 + 1;
  return (fitted ? 4 : 3) * map_width * rows * static_cast<long>(sizeof(double));
}

ColumnPosition ColumnSums::position_of(double sine) const {
  const int row = static_cast<int>(std::acos(std::clamp(sine, -1.0, 1.0)) * (height_ / pi));
  return {sine, std::clamp(row, 0, height_ - 1)};
}

void ColumnSums::add_at(int column, const ColumnPosition& position, double part, glm::dvec4& sum) const {
  const auto row = static_cast<std::size_t>(position.row);
  const double down = (sines_[row] - position.sine) / (sines_[row] - sines_[row + 1]);
  const double* upper = sums_at(column, position.row);
  const double* lower = upper + parts_;
  for (int i = 0; i < parts_; ++i) {
    sum[i] += part * (upper[i] + down * (lower[i] - upper[i]));
  }
}

void ColumnSums::add_above(int column, const ColumnPosition& from, const ColumnPosition& to, double part,
                           glm::dvec4& sum) const {
  if (from.row == to.row) {
    // Within a texel the light above a line is linear along the line, so its mean is the value at
    // the middle.
    return add_at(column, {0.5 * (from.sine + to.sine), from.row}, part, sum);
  }
  const int step = to.row > from.row ? 1 : -1;
  const double part_per_sine = part / (to.sine - from.sine);
  double at = from.sine;
  for (int row = from.row;; row += step) {
    const double next = row == to.row ? to.sine : sines_[static_cast<std::size_t>(step > 0 ? row + 1 : row)];
    add_at(column, {0.5 * (at + next), row}, part_per_sine * (next - at), sum);
    if (row == to.row) {
      return;
    }
    at = next;
  }
}

}  // namespace ergodome
