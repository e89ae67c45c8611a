#include "kernels/launch/launch.h"

#include "kernels/launch/launch_cuda.h"
#include "kernels/launch/parallel_for.h"

namespace ergodome {

namespace {

//! Kernel indices a thread takes at a time: some tens of microseconds of work, so that uneven rays balance.
constexpr int grain = 32;

int index_count(int elements, int lanes) { return elements > 0 ? (elements - 1) / lanes + 1 : 0; }

const KernelTable& active_table() { return kernel_table(active_instruction_set()); }

}  // namespace

const char* cuda_unavailable_reason() {
  static const char* const reason = find_cuda_unavailable_reason();
  return reason;
}

void trace_rays(Backend backend, const RayBatch<float>& batch) {
  if (backend == Backend::cuda) {
    trace_rays_cuda(batch);
    return;
  }
  const KernelTable& table = active_table();
  parallel_for(index_count(batch.count, table.lanes_float), grain,
               [&](int begin, int end) { table.trace_rays_float(batch, begin, end); });
}

void trace_rays(Backend backend, const RayBatch<double>& batch) {
  if (backend == Backend::cuda) {
    trace_rays_cuda(batch);
    return;
  }
  const KernelTable& table = active_table();
  parallel_for(index_count(batch.count, table.lanes_double), grain,
               [&](int begin, int end) { table.trace_rays_double(batch, begin, end); });
}

void trace_pixels(Backend backend, const PixelBatch& batch) {
  if (backend == Backend::cuda) {
    trace_pixels_cuda(batch);
    return;
  }
  const KernelTable& table = active_table();
  const int pixels = batch.row_count * batch.projection.width_px;
  parallel_for(index_count(pixels, table.lanes_float), grain,
               [&](int begin, int end) { table.trace_pixels(batch, begin, end); });
}

void shade_pixels(Backend backend, const ShadeBatch& batch) {
  if (backend == Backend::cuda) {
    shade_pixels_cuda(batch);
    return;
  }
  const KernelTable& table = active_table();
  parallel_for(batch.count, 16 * grain, [&](int begin, int end) { table.shade_pixels(batch, begin, end); });
}

}  // namespace ergodome
