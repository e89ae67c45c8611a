#include "kernels/launch/check_numbers.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "kernels/core/error.h"
#include "kernels/launch/launch_cuda.h"

namespace ergodome {

namespace {

std::atomic<bool>& flag() {
  static std::atomic<bool> checked = [] {
    const char* wish = std::getenv("ERGODOME_CHECK_NUMBERS");
    return wish != nullptr && std::strcmp(wish, "0") != 0 && *wish != '\0';
  }();
  return checked;
}

//! Maximum number of values that are copied from a device at a time.
constexpr long block = 1 << 16;

template <class S>
void require(const std::string& kernel, Backend backend, const char* channel, const S* values, long count) {
  if (values == nullptr) {
    return;
  }
  std::vector<S> copy(backend == Backend::cuda ? static_cast<std::size_t>(std::min(block, count)) : 0);
  for (long first = 0; first < count; first += block) {
    const long length = std::min(block, count - first);
    const S* here = values + first;
    if (backend == Backend::cuda) {
      copy_from_cuda(copy.data(), here, static_cast<std::size_t>(length) * sizeof(S));
      here = copy.data();
    }
    const S* bad = std::find_if(here, here + length, [](S value) { return !std::isfinite(value); });
    if (bad != here + length) {
      throw Error("kernel " + kernel,
                  std::string(channel) + "[" + std::to_string(first + (bad - here)) + "] of " + std::to_string(count) +
                      " is " + std::to_string(*bad),
                  "report this with the show to the developers, or unset ERGODOME_CHECK_NUMBERS");
    }
  }
}

//! Checks the outputs of comparisons between a grid and traced rays.
template <class Batch>
void require_checks(const std::string& kernel, Backend backend, const Batch& batch) {
  require_finite(kernel, backend, "error_px", batch.error_px, batch.count);
  require_finite(kernel, backend, "area_px", batch.area_px, batch.count);
}

template <class S>
void check_rays(const std::string& kernel, Backend backend, const RayBatch<S>& batch) {
  for (const S* sky : batch.sky) {
    require_finite(kernel, backend, "sky", sky, batch.count);
  }
  require_finite(kernel, backend, "frequency_ratio", batch.frequency_ratio, batch.count);
  require_finite(kernel, backend, "status", batch.status, batch.count);
  require_finite(kernel, backend, "steps", batch.steps, batch.count);
  require_finite(kernel, backend, "error_estimate", batch.error_estimate, batch.count);
  require_finite(kernel, backend, "mino_time", batch.mino_time, batch.count);
}

}  // namespace

bool numbers_are_checked() { return flag().load(std::memory_order_relaxed); }
void set_numbers_checked(bool on) { flag().store(on, std::memory_order_relaxed); }

void require_finite(const std::string& kernel, Backend backend, const char* channel, const float* values, long count) {
  require(kernel, backend, channel, values, count);
}

void require_finite(const std::string& kernel, Backend backend, const char* channel, const double* values, long count) {
  require(kernel, backend, channel, values, count);
}

void check_outputs(const std::string& kernel, Backend backend, const RayBatch<float>& batch) {
  check_rays(kernel, backend, batch);
}

void check_outputs(const std::string& kernel, Backend backend, const RayBatch<double>& batch) {
  check_rays(kernel, backend, batch);
}

void check_outputs(const std::string& kernel, Backend backend, const PixelBatch& batch) {
  const long count = static_cast<long>(batch.row_count) * batch.projection.width_px;
  const LensPixels& out = batch.out;
  for (int axis = 0; axis < 3; ++axis) {
    require_finite(kernel, backend, "sky", out.sky[axis], count);
    require_finite(kernel, backend, "sky_along_x", out.sky_along_x[axis], count);
    require_finite(kernel, backend, "sky_along_y", out.sky_along_y[axis], count);
  }
  require_finite(kernel, backend, "coverage", out.coverage, count);
  require_finite(kernel, backend, "frequency_ratio", out.frequency_ratio, count);
  require_finite(kernel, backend, "steps", out.steps, count);
  require_finite(kernel, backend, "error_estimate", out.error_estimate, count);
  require_finite(kernel, backend, "half_orbits", out.half_orbits, count);
}

void check_outputs(const std::string& kernel, Backend backend, const OmniBatch& batch) {
  check_outputs(kernel, backend, batch.pixels);
}

void check_outputs(const std::string& kernel, Backend backend, const LookUpBatch& batch) {
  check_outputs(kernel, backend, batch.pixels);
}

void check_outputs(const std::string& kernel, Backend backend, const OmniLookUpBatch& batch) {
  check_outputs(kernel, backend, batch.pixels);
}

void check_outputs(const std::string& kernel, Backend backend, const LookUpRaysBatch<double>& batch) {
  check_outputs(kernel, backend, batch.rays);
}

void check_outputs(const std::string& kernel, Backend backend, const QuadtreeRaysBatch& batch) {
  check_outputs(kernel, backend, batch.rays);
}

void check_outputs(const std::string& kernel, Backend backend, const QuadtreePixelBatch& batch) {
  check_outputs(kernel, backend, batch.pixels);
}

void check_outputs(const std::string& kernel, Backend backend, const ShadeBatch& batch) {
  require_finite(kernel, backend, "rgba", batch.rgba, 4L * batch.count);
}

void check_outputs(const std::string& kernel, Backend backend, const DiskNodeBatch& batch) {
  for (int set = 0; set < (batch.camera.pattern ? layer_orders : 1); ++set) {
    require_finite(kernel, backend, "nodes", batch.nodes[set], static_cast<long>(batch.count) * floats_a_node);
  }
}

void check_outputs(const std::string& kernel, Backend backend, const DiskCheckBatch& batch) {
  require_checks(kernel, backend, batch);
}

void check_outputs(const std::string& kernel, Backend backend, const DiskGridCheckBatch& batch) {
  require_checks(kernel, backend, batch);
}

void check_outputs(const std::string& kernel, Backend backend, const NearFieldBatch& batch) {
  require_finite(kernel, backend, "rgba", batch.rgba, 4L * batch.pixels.row_count * batch.pixels.projection.width_px);
}

void check_outputs(const std::string& kernel, Backend backend, const OverlayBatch& batch) {
  require_finite(kernel, backend, "rgba", batch.rgba, 4L * batch.projection.width_px * batch.projection.height_px);
}

void check_outputs(const std::string& kernel, Backend backend, const StarLightBatch& batch) {
  require_finite(kernel, backend, "rgba", batch.rgba, 4L * batch.row_count * batch.projection.width_px);
}

void check_outputs(const std::string& kernel, Backend backend, const BlendCheckBatch& batch) {
  require_checks(kernel, backend, batch);
}

}  // namespace ergodome
