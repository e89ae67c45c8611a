#pragma once

#include "kernels/core/host_device.h"
#include "kernels/eyes/omni/omni_batches.h"

namespace ergodome::inline ERGO_TARGET {

//! Kernels for omnidirectional eyes, compiled once per instruction set: rays, nodes and cells of
//! grids, pixels that are read from grids, and lensed images of stars. In a separate source, so
//! that they do not affect how other kernels are compiled.
void trace_omni_rays(const OmniRayBatch& batch, int begin, int end);
void trace_omni_nodes(const OmniNodeBatch& batch, int begin, int end);
void check_omni_cells(const OmniCheckBatch& batch, int begin, int end);
void look_up_omni_pixels(const OmniLookUpBatch& batch, int begin, int end);
void find_omni_star_images(const OmniStarBatch<float>& batch, int begin, int end);
void find_omni_star_images(const OmniStarBatch<double>& batch, int begin, int end);

}  // namespace ergodome::inline ERGO_TARGET
