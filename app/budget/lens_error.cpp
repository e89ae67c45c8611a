#include "app/budget/lens_error.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "kernels/projection/pixel_measure.h"
#include "render/accuracy/statistics.h"
#include "render/backend/buffer.h"
#include "render/eyes/eye_camera.h"
#include "render/passes/sky/sky_shading.h"

namespace ergodome {

namespace {

//! Divides [0, whole) into `parts` intervals of about equal length and returns a random integer in
//! the one with index `part`.
int within_part(std::mt19937_64& random, int part, int parts, int whole) {
  const auto begin = static_cast<std::int64_t>(part) * whole / parts;
  const auto end = static_cast<std::int64_t>(part + 1) * whole / parts;
  return static_cast<int>(begin + static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(end - begin)));
}

}  // namespace

RowSamples row_samples(const Projection& projection, int rows, int columns, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  rows = std::clamp(rows, 1, projection.height_px);
  RowSamples samples;
  samples.columns = std::clamp(columns, 1, projection.width_px);
  for (int i = 0; i < rows; ++i) {
    const int row = within_part(random, i, rows, projection.height_px);
    samples.rows.push_back(row);
    for (int k = 0; k < samples.columns; ++k) {
      samples.pixels.push_back(static_cast<std::int64_t>(row) * projection.width_px +
                               within_part(random, k, samples.columns, projection.width_px));
    }
  }
  return samples;
}

LensErrors::LensErrors(const EyeCamera& eye, const Projection& projection, RowSamples samples, double pixel)
    : projection_(projection), samples_(std::move(samples)), reference_(eye, projection, samples_.pixels, pixel) {}

std::vector<double> LensErrors::errors(Backend backend, const LensSource& lens, PixelNeed need) const {
  constexpr std::size_t read_channels = 4;
  const std::size_t channel_count = need == PixelNeed::footprint ? 10 : read_channels;
  const auto width = static_cast<std::size_t>(projection_.width_px);
  const Buffer<float> row(backend, channel_count * width, "measured row");
  LensPixels out{};
  out.coverage = row.data();
  for (std::size_t k = 0; k < 3; ++k) {
    out.sky[k] = row.data() + (k + 1) * width;
    if (need == PixelNeed::footprint) {
      out.sky_along_x[k] = row.data() + (k + 4) * width;
      out.sky_along_y[k] = row.data() + (k + 7) * width;
    }
  }
  std::vector<float> seen(read_channels * width);
  std::vector<double> errors;
  for (std::size_t i = 0; i < samples_.pixels.size(); ++i) {
    const auto columns = static_cast<std::size_t>(samples_.columns);
    if (i % columns == 0) {
      lens.fill(samples_.rows[i / columns], 1, out);
      row.read(seen.data(), seen.size());
    }
    const auto x = static_cast<std::size_t>(samples_.pixels[i]) % width;
    const Vector3<double> sky = {static_cast<double>(seen[width + x]), static_cast<double>(seen[2 * width + x]),
                                 static_cast<double>(seen[3 * width + x])};
    // A dark pixel has no direction. A failed pixel has a NaN direction; its error is NaN, which
    // summary_of() counts as infinite.
    const bool dark = !(seen[x] > 0.0F) || dot(sky, sky) == 0.0;
    if (reference_.counts(i) && (reference_.is_lit(i) || !dark)) {
      const Vector3<double> miss = reference_.miss(i, dark ? std::nullopt : std::optional(sky));
      errors.push_back(std::sqrt(dot(miss, miss)));
    }
  }
  return errors;
}

BudgetCheck check_error(ShowRenderer& renderer, const Show& show, const FrameQuality& quality, int size_px, int moments,
                        std::uint64_t seed, int rows) {
  std::mt19937_64 random(seed);
  renderer.set_quality(quality);
  std::vector<double> errors_px;
  BudgetCheck check;
  for (int i = 0; i < moments; ++i) {
    const double time_s = show.duration_s * static_cast<double>(random() >> 11U) * 0x1p-53;
    renderer.apply(time_s);
    const CameraPose pose = camera_pose(show, time_s);
    const Projection projection = make_projection(renderer.show().view, size_px > 0 ? size_px : show.view.size_px, 0.0);
    const LensErrors exact(eye_camera(renderer.show(), pose, 0.0), projection,
                           row_samples(projection, rows, rows, random()), pixel_angle(projection));
    const bool footprints = lens_channels(ViewMode::sky, shading_of(renderer.show())).footprint;
    const auto lens = renderer.lens_of(pose, projection, {time_s});
    const std::vector<double> all =
        exact.errors(renderer.backend(), *lens, footprints ? PixelNeed::footprint : PixelNeed::sky);
    errors_px.push_back(summary_of(all).p99);
    if (errors_px.back() >= check.worst_px) {
      check.worst_px = errors_px.back();
      check.worst_time_s = time_s;
    }
  }
  check.moments = moments;
  check.median_px = spread_of(errors_px).median;
  return check;
}

}  // namespace ergodome
