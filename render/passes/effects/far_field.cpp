#include "render/passes/effects/far_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "content/images/image_library.h"
#include "kernels/core/angles.h"
#include "kernels/core/error.h"
#include "kernels/launch/parallel_for.h"

namespace ergodome {

namespace {

constexpr int widest_aperture_px = 1025;
constexpr double reference_nm = 550.0;
//! Radius of the first dark ring of a round aperture, in units of wavelength / diameter: the first
//! zero of the Bessel function J1, divided by pi.
constexpr double first_ring = 1.2196698912665045;
//! Radius of the first dark ring in pixels, for the reference wavelength and a scale of 1.
constexpr double first_ring_px = 2.0;
//! Width of a vane as a fraction of the aperture's radius.
constexpr double vane_width = 0.03;

void check(const ApertureSettings& settings) {
  const auto require = [](bool sound, const std::string& problem, const char* remedy) {
    if (!sound) {
      throw Error("aperture", problem, remedy);
    }
  };
  require(settings.blades == 0 || (settings.blades >= 3 && settings.blades <= 64),
          fmt::format("has {} blades", settings.blades), "choose 3 to 64, or 0 for a round aperture");
  require(settings.vanes >= 0 && settings.vanes <= 64, fmt::format("has {} vanes", settings.vanes), "choose 0 to 64");
  require(settings.obstruction >= 0.0 && settings.obstruction <= 0.9,
          fmt::format("has an obstruction of {}", settings.obstruction), "choose 0 to 0.9 of the radius");
  require(settings.size_px >= 3 && settings.size_px <= widest_aperture_px && settings.size_px % 2 == 1,
          fmt::format("has a pattern of {} px", settings.size_px), "choose an odd width from 3 to 1025 px");
  require(settings.scale >= 0.25 && settings.scale <= 8.0, fmt::format("has a scale of {}", settings.scale),
          "choose 0.25 to 8");
}

//! Returns the fraction of a cell that is inside a straight edge, if the cell's center is `depth`
//! cells inside.
double inside_edge(double depth) { return std::clamp(depth + 0.5, 0.0, 1.0); }

//! Returns the fraction of a cell that transmits light. (x, y): position of the cell from the axis
//! [cells], y upwards. `radius`: radius of the aperture [cells].
double transmission(const ApertureSettings& settings, double radius, double x, double y) {
  const double distance = std::hypot(x, y);
  double depth = radius - distance;
  for (int i = 0; i < settings.blades; ++i) {
    const double angle = pi / 2.0 + 2.0 * pi * i / settings.blades;
    depth = std::min(depth, radius * std::cos(pi / settings.blades) - x * std::cos(angle) - y * std::sin(angle));
  }
  double part = inside_edge(depth);
  if (settings.obstruction > 0.0) {
    part *= inside_edge(distance - settings.obstruction * radius);
  }
  const double half_vane = 0.5 * vane_width * radius;
  for (int i = 0; i < settings.vanes; ++i) {
    const double angle = pi / 2.0 + 2.0 * pi * i / settings.vanes;
    const double along = x * std::cos(angle) + y * std::sin(angle);
    const double across = y * std::cos(angle) - x * std::sin(angle);
    // The difference of two edges is also correct for vanes thinner than a cell.
    part *= 1.0 - inside_edge(along) * (inside_edge(across + half_vane) - inside_edge(across - half_vane));
  }
  return part;
}

//! Returns the smallest power of two that is at least `minimum`.
int power_of_two(double minimum) {
  return static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::ceil(std::max(minimum, 1.0)))));
}

}  // namespace

FarField::FarField(const ApertureSettings& settings) {
  check(settings);
  // The mask has at least 4 cells per period of the light at the sides of the square, so that the
  // steps of the mask are not visible. The cells of the transform are smaller than rings and
  // pixels.
  diameter_ = std::clamp(power_of_two(1.7 * settings.size_px / settings.scale), 64, 1024);
  cells_ = std::min(diameter_ * std::max(4, power_of_two(4.0 * settings.scale)), 4096);
  cells_per_px_ = first_ring * cells_ / diameter_ / (first_ring_px * settings.scale);
  std::vector<float> mask(static_cast<std::size_t>(cells_) * static_cast<std::size_t>(cells_));
  draw_mask(settings, mask.data());
  std::string problem;
  const std::vector<float> field = image_library().transform(mask.data(), cells_, problem);
  if (field.empty()) {
    throw Error("aperture", "cannot be transformed: " + problem, "choose a smaller diffraction.size_px");
  }
  integrate(field.data());
}

void FarField::draw_mask(const ApertureSettings& settings, float* cells) const {
  // One more cell on each side, because edges extend by half a cell.
  const int rows = diameter_ + 2;
  const double middle = 0.5 * (rows - 1);
  parallel_for(rows, 16, [&](int begin, int end) {
    for (int j = begin; j < end; ++j) {
      float* row = cells + static_cast<std::size_t>(j) * static_cast<std::size_t>(cells_);
      for (int i = 0; i < rows; ++i) {
        row[i] = static_cast<float>(transmission(settings, 0.5 * diameter_, i - middle, middle - j));
      }
    }
  });
}

void FarField::integrate(const float* amplitudes) {
  before_.assign(offset(0, cells_ + 1), 0.0);
  const int half = cells_ / 2;
  for (int j = 0; j < cells_; ++j) {
    const float* line =
        amplitudes + 2 * static_cast<std::size_t>((j + half) % cells_) * static_cast<std::size_t>(cells_);
    double sum = 0.0;
    for (int i = 0; i < cells_; ++i) {
      const float* amplitude = line + 2 * ((i + half) % cells_);
      const double re = static_cast<double>(amplitude[0]);
      const double im = static_cast<double>(amplitude[1]);
      // At its edges the mask rises from 0 to 1 over one cell. That attenuates the amplitude by
      // sin(f) / f, so the intensity is divided by the square of this factor.
      const double f = pi * std::hypot(i - half, j - half) / cells_;
      const double dimming = f > 0.0 ? std::sin(f) / f : 1.0;
      sum += (re * re + im * im) / (dimming * dimming);
      before_[offset(i + 1, j + 1)] = before_[offset(i + 1, j)] + sum;
    }
  }
  const double all = before_.back();
  for (double& light : before_) {
    light /= all;
  }
}

double FarField::light_before(double x_px, double y_px, double wavelength_nm) const {
  const double per_px = cells_per_px_ * reference_nm / wavelength_nm;
  // Frequency 0 is at the center of cell cells_ / 2.
  const double middle = 0.5 * cells_ + 0.5;
  const double x = std::clamp(middle + per_px * x_px, 0.0, static_cast<double>(cells_));
  const double y = std::clamp(middle + per_px * y_px, 0.0, static_cast<double>(cells_));
  const int i = std::min(static_cast<int>(x), cells_ - 1);
  const int j = std::min(static_cast<int>(y), cells_ - 1);
  const double* above = before_.data() + offset(i, j);
  const double* below = above + cells_ + 1;
  const auto mix = [](double a, double b, double t) { return a + t * (b - a); };
  return mix(mix(above[0], above[1], x - i), mix(below[0], below[1], x - i), y - j);
}

}  // namespace ergodome
