#pragma once

#include <string>

#include "kernels/launch/kernel_table.h"
#include "kernels/launch/launch.h"

// Checks the outputs of kernels for NaN and infinity.
namespace ergodome {

//! Returns whether the outputs of every kernel launch are scanned for NaN and infinity. Enabled by
//! the environment variable ERGODOME_CHECK_NUMBERS=1 or set_numbers_checked(). A launch then reads
//! all its outputs, which a GPU first copies to the host; if disabled, the cost is one flag.
bool numbers_are_checked();
void set_numbers_checked(bool on);

//! Throws Error with kernel, channel and index of the first non-finite value. Accepts null buffers.
void require_finite(const std::string& kernel, Backend backend, const char* channel, const float* values, long count);
void require_finite(const std::string& kernel, Backend backend, const char* channel, const double* values, long count);

//! Checks all outputs of a kernel, as require_finite() does.
void check_outputs(const std::string& kernel, Backend backend, const RayBatch<float>& batch);
void check_outputs(const std::string& kernel, Backend backend, const RayBatch<double>& batch);
void check_outputs(const std::string& kernel, Backend backend, const PixelBatch& batch);
void check_outputs(const std::string& kernel, Backend backend, const OmniBatch& batch);
void check_outputs(const std::string& kernel, Backend backend, const LookUpBatch& batch);
void check_outputs(const std::string& kernel, Backend backend, const OmniLookUpBatch& batch);
void check_outputs(const std::string& kernel, Backend backend, const LookUpRaysBatch<double>& batch);
void check_outputs(const std::string& kernel, Backend backend, const QuadtreeRaysBatch& batch);
void check_outputs(const std::string& kernel, Backend backend, const QuadtreePixelBatch& batch);
void check_outputs(const std::string& kernel, Backend backend, const ShadeBatch& batch);
void check_outputs(const std::string& kernel, Backend backend, const NearFieldBatch& batch);
void check_outputs(const std::string& kernel, Backend backend, const OverlayBatch& batch);
void check_outputs(const std::string& kernel, Backend backend, const BlendCheckBatch& batch);
void check_outputs(const std::string& kernel, Backend backend, const StarLightBatch& batch);

void check_outputs(const std::string& kernel, Backend backend, const DiskNodeBatch& batch);
void check_outputs(const std::string& kernel, Backend backend, const DiskCheckBatch& batch);
void check_outputs(const std::string& kernel, Backend backend, const DiskGridCheckBatch& batch);

template <class S, class Camera>
void check_outputs(const std::string& kernel, Backend backend, const NodeBatch<S, Camera>& batch) {
  require_finite(kernel, backend, "nodes", batch.nodes, static_cast<long>(batch.count) * floats_a_node);
}

template <class S, class Camera>
void check_outputs(const std::string& kernel, Backend backend, const CheckBatch<S, Camera>& batch) {
  require_finite(kernel, backend, "error_px", batch.error_px, batch.count);
  require_finite(kernel, backend, "area_px", batch.area_px, batch.count);
  require_finite(kernel, backend, "gamma_parts", batch.gamma_parts, batch.count);
  require_finite(kernel, backend, "s_parts", batch.s_parts, batch.count);
}

template <class S, class Camera>
void check_outputs(const std::string& kernel, Backend backend, const StarImageBatch<S, Camera>& batch) {
  for (const S* direction : batch.direction) {
    require_finite(kernel, backend, "direction", direction, batch.count);
  }
  require_finite(kernel, backend, "solid_angle", batch.solid_angle, batch.count);
  require_finite(kernel, backend, "stretch", batch.stretch, batch.count);
  require_finite(kernel, backend, "frequency_ratio", batch.frequency_ratio, batch.count);
  require_finite(kernel, backend, "miss", batch.miss, batch.count);
  require_finite(kernel, backend, "change", batch.change, batch.count);
}

}  // namespace ergodome
