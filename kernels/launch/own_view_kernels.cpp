#include "kernels/core/host_device.h"
#include "kernels/launch/view_kernels.h"
#include "kernels/spacetime/trace/follow_rays_kernel.h"

// Compiled once per instruction set; ERGO_TARGET names it.
namespace ergodome::inline ERGO_TARGET {

const ViewKernels& own_view_kernels();

namespace {

void follow_rays(const FollowBatch& batch, int begin, int end) {
  dispatch_follower(batch.method, [&](auto follower) {
    const FollowRays<decltype(follower), WidePack<float>> follow{batch};
    for (int index = begin; index < end; ++index) {
      follow(index);
    }
  });
}

}  // namespace

const ViewKernels& own_view_kernels() {
  static constexpr ViewKernels kernels = {RealTraits<WidePack<float>>::lane_count, &follow_rays};
  return kernels;
}

}  // namespace ergodome::inline ERGO_TARGET
