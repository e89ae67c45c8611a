#include "render/lens/follow_lens.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "kernels/launch/cuda.h"
#include "kernels/launch/launch.h"

namespace ergodome {

namespace {

//! Maximum number of steps; the same as in the published tracer.
constexpr int followed_step_limit = 2000;

}  // namespace

std::vector<WatchedShell> watched_shells(const std::vector<ShellSettings>& shells) {
  std::vector<WatchedShell> watched;
  for (const ShellSettings& shell : shells) {
    if (is_visible(shell)) {
      watched.push_back({static_cast<float>(1.0 / shell.radius), shell.fill_opacity >= 1.0});
    }
  }
  std::ranges::stable_sort(watched, std::less<>(), &WatchedShell::u);
  return watched;
}

FollowLens::FollowLens(Backend backend, const EyeCamera& eye, const Projection& projection, double tolerance_px,
                       FollowedRays rays)
    : backend_(backend), rays_(std::move(rays)), prototype_(pixel_batch(eye, projection, tolerance_px)) {
  prototype_.settings.step_limit = followed_step_limit;
}

void FollowLens::fill(int first_row, int row_count, const LensPixels& out) const {
  FollowBatch batch{prototype_, rays_.method, rays_.shells.data(), static_cast<int>(rays_.shells.size())};
  batch.pixels.first_row = first_row;
  batch.pixels.row_count = row_count;
  const std::size_t pixels =
      static_cast<std::size_t>(row_count) * static_cast<std::size_t>(prototype_.projection.width_px);
  std::vector<float> coverage(pixels);
  std::vector<float> error(pixels);
  std::vector<float> steps(out.steps != nullptr ? pixels : 0);
  batch.pixels.out = {};
  batch.pixels.out.coverage = coverage.data();
  batch.pixels.out.error_estimate = error.data();
  batch.pixels.out.steps = out.steps != nullptr ? steps.data() : nullptr;
  launch(batch);
  if (rays_.logarithmic) {
    std::ranges::transform(steps, steps.begin(), [](float count) { return std::log10(std::max(count, 1.0F)); });
  }
  const auto give = [&](const std::vector<float>& from, float* to) {
    if (backend_ == Backend::cuda) {
      copy_to_cuda(to, from.data(), from.size() * sizeof(float));
    } else {
      std::ranges::copy(from, to);
    }
  };
  give(coverage, out.coverage);
  give(error, out.error_estimate);
  if (out.steps != nullptr) {
    give(steps, out.steps);
  }
}

}  // namespace ergodome
