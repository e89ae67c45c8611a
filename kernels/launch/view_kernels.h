#pragma once

#include "kernels/launch/instruction_set.h"
#include "kernels/spacetime/trace/follow_rays.h"

// CPU kernels that few pictures need.
namespace ergodome {

//! CPU kernels that few pictures need, otherwise like KernelTable. They are compiled separately, so
//! that they do not affect how other kernels are compiled.
struct ViewKernels {
  int lanes_float;
  void (*follow_rays)(const FollowBatch& batch, int begin, int end);
};

//! Returns the kernels compiled for an instruction set, for which has_instruction_set() must be
//! true.
const ViewKernels& view_kernels(InstructionSet set);

//! Follows the rays of an image on all CPU threads; see FollowBatch.
void follow_rays(const FollowBatch& batch);

}  // namespace ergodome
