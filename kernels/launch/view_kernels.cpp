#include "kernels/launch/view_kernels.h"

#include "kernels/launch/run_on_cpu.h"

namespace ergodome {

#if defined(ERGODOME_SIMD_PORTABLE)
inline namespace portable {
const ViewKernels& own_view_kernels();
}
#endif
#if defined(ERGODOME_SIMD_AVX2)
namespace avx2 {
const ViewKernels& own_view_kernels();
}
#endif
#if defined(ERGODOME_SIMD_AVX512)
namespace avx512 {
const ViewKernels& own_view_kernels();
}
#endif

const ViewKernels& view_kernels(InstructionSet set) {
  switch (set) {
    case InstructionSet::avx512:
#if defined(ERGODOME_SIMD_AVX512)
      return avx512::own_view_kernels();
#endif
    case InstructionSet::avx2:
#if defined(ERGODOME_SIMD_AVX2)
      return avx2::own_view_kernels();
#endif
    case InstructionSet::portable:
#if defined(ERGODOME_SIMD_PORTABLE)
      return portable::own_view_kernels();
#endif
      break;
  }
  throw missing_instruction_set();
}

void follow_rays(const FollowBatch& batch) {
  const int pixels = batch.pixels.row_count * batch.pixels.projection.width_px;
  static WorkCounter counter("follow_rays");
  const WorkScope work(counter, pixels);
  const ViewKernels& kernels = view_kernels(active_instruction_set());
  run_on_cpu(kernels.follow_rays, batch, pixels, kernels.lanes_float);
  if (numbers_are_checked()) {
    require_finite(counter.name(), Backend::cpu, "error_estimate", batch.pixels.out.error_estimate, pixels);
  }
}

}  // namespace ergodome
