#include "render/lens/grid/screen_error.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "kernels/core/angles.h"
#include "kernels/launch/launch.h"
#include "kernels/lens/blend_check.h"
#include "kernels/lens/lens_chart.h"
#include "render/lens/spread_point.h"

namespace ergodome {

namespace {

constexpr int reference_step_limit = 400;
//! Desired number of samples of leaf_samples(): enough to resolve a thousandth of the sky.
constexpr double wished_samples = 10'000.0;
//! In screen_samples(), no sample represents more than 1 / wished_parts of the total area on the
//! screen. Most represent less, because leaves are divided into quarters, and the number of samples
//! is about twice this.
constexpr double wished_parts = 6'000.0;

//! Returns the weighted quantile of the values: that below which the fraction `share` of the weight
//! lies.
double quantile(const std::vector<double>& values, const std::vector<double>& weights,
                const std::vector<std::size_t>& order, double share) {
  const double whole = std::accumulate(weights.begin(), weights.end(), 0.0);
  double below = 0.0;
  for (const std::size_t i : order) {
    below += weights[i];
    if (below >= share * whole) {
      return values[i];
    }
  }
  return order.empty() ? 0.0 : values[order.back()];
}

//! Returns the area on an observer's screen per area of the chart, in γ [turns] times s, at a point
//! [px²], as in CheckBlend.
double screen_density(const LensChart& chart, const LensView& view, double gamma_turns, double s) {
  const ChartStretch<double> stretch = chart_stretch(chart, gamma_turns, s);
  const Vector3<MixedDual<double>> n = chart_direction_at(chart, gamma_turns, stretch.alpha);
  const double scale = observed_scale(view.observer, Vector3<double>{n.x.value, n.y.value, n.z.value}) / view.pixel;
  return 2.0 * pi * std::abs(std::sin(stretch.alpha.value) * stretch.alpha.along_y) * scale * scale;
}

//! Places samples in the boxes of a chart's leaves according to their area on a screen.
class ScreenSampler {
 public:
  ScreenSampler(const LensChart& chart, const LensView& view) : chart_(chart), view_(view) {}

  //! Estimates the area of a box on the screen from side² points in it [px²].
  [[nodiscard]] double area_of(const LeafBox& box, int side) const {
    double sum = 0.0;
    for (int row = 0; row < side; ++row) {
      const double s = box.s + (row + 0.5) / side * box.height;
      for (int column = 0; column < side; ++column) {
        sum += screen_density(chart_, view_, box.gamma_turns + (column + 0.5) / side * box.width_turns, s);
      }
    }
    return sum / (side * side) * box.width_turns * box.height;
  }

  //! Divides a box into quarters, and these again while they are larger than `maximum` [px²], at
  //! most deepest_part times. Adds a sample in each undivided part.
  void add(const LeafBox& box, double maximum, int depth, ChartSamples& samples) const {
    for (int quarter = 0; quarter < 4; ++quarter) {
      const double width = 0.5 * box.width_turns;
      const double height = 0.5 * box.height;
      const int upper = quarter / 2;
      const int right = quarter % 2;
      const LeafBox part = {box.gamma_turns + right * width, box.s + upper * height, width, height};
      if (depth < deepest_part && area_of(part, 2) > maximum) {
        add(part, maximum, depth + 1, samples);
        continue;
      }
      const SquarePoint within = spread_point(samples.s.size());
      samples.gamma_turns.push_back(part.gamma_turns + within.x * width);
      samples.s.push_back(part.s + within.y * height);
      samples.extent.push_back(width * height);
    }
  }

 private:
  static constexpr int deepest_part = 10;

  const LensChart& chart_;
  const LensView& view_;
};

}  // namespace

ChartSamples screen_samples(const LensStation& station, const LensChart& chart, const LensView& view) {
  const ScreenSampler sampler(chart, view);
  std::vector<LeafBox> boxes = leaf_boxes(station);
  if (station.mirrored) {
    const std::size_t half = boxes.size();
    for (std::size_t i = 0; i < half; ++i) {
      LeafBox other = boxes[i];
      other.gamma_turns = 1.0 - other.gamma_turns - other.width_turns;
      boxes.push_back(other);
    }
  }
  double whole = 0.0;
  for (const LeafBox& box : boxes) {
    whole += sampler.area_of(box, 4);
  }
  ChartSamples samples;
  for (const LeafBox& box : boxes) {
    sampler.add(box, whole / wished_parts, 0, samples);
  }
  return samples;
}

ChartSamples leaf_samples(const LensStation& station) {
  ChartSamples samples;
  const auto add = [&](double gamma_turns, double s, double extent) {
    samples.gamma_turns.push_back(gamma_turns);
    samples.s.push_back(s);
    samples.extent.push_back(extent);
  };
  const double wished = std::sqrt(wished_samples / static_cast<double>(station.leaf_count()));
  const int side = static_cast<int>(std::clamp(std::ceil(wished), 2.0, 8.0));
  for (const LeafBox& box : leaf_boxes(station)) {
    const double extent = box.width_turns * box.height / (side * side);
    for (int row = 0; row < side; ++row) {
      for (int column = 0; column < side; ++column) {
        const SquarePoint within = spread_point(samples.s.size());
        const double gamma_turns = box.gamma_turns + (column + within.x) / side * box.width_turns;
        const double s = box.s + (row + within.y) / side * box.height;
        add(gamma_turns, s, extent);
        if (station.mirrored) {
          add(1.0 - gamma_turns, s, extent);
        }
      }
    }
  }
  return samples;
}

ChartSamples lattice_samples(int columns, int rows) {
  ChartSamples samples;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      samples.gamma_turns.push_back((column + 0.5) / columns);
      samples.s.push_back((row + 0.5) / rows);
      samples.extent.push_back(1.0 / (columns * rows));
    }
  }
  return samples;
}

ScreenError bounds_of(const std::vector<double>& error_px, const std::vector<double>& area_px, double share) {
  // Minimum fraction of the sky for a screen: the samples do not resolve a smaller one.
  constexpr double min_share = 0.1;
  std::vector<std::size_t> order(error_px.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return error_px[a] < error_px[b]; });
  return {quantile(error_px, area_px, order, 1.0 - 0.01 * std::max(share, min_share)),
          quantile(error_px, area_px, order, 0.999)};
}

ScreenError measure_screen_error(const LensBlend& lens, const LensView& view, const ChartSamples& samples) {
  const CameraStation rain =
      make_camera_station(view.spacetime, view.position.r, view.position.theta, 0.0, ObserverMotion::rain);
  const std::size_t count = samples.s.size();
  std::vector<double> error_px(count);
  std::vector<double> area_px(count);
  launch(BlendCheckBatch{{rain, lens.chart, {1e-9, reference_step_limit, true}},
                         lens,
                         view.observer,
                         view.pixel,
                         static_cast<int>(count),
                         samples.gamma_turns.data(),
                         samples.s.data(),
                         error_px.data(),
                         area_px.data()});
  for (std::size_t i = 0; i < count; ++i) {
    area_px[i] *= samples.extent[i];
  }
  return bounds_of(error_px, area_px, view.share);
}

}  // namespace ergodome
