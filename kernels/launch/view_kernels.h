#pragma once

#include "kernels/launch/instruction_set.h"
#include "kernels/spacetime/trace/follow_rays.h"

namespace ergodome {

//! The CPU kernels of what few pictures call for, as those of KernelTable: compiled apart, so that they change nothing in how the others are.
struct ViewKernels {
  int lanes_float;
  void (*follow_rays)(const FollowBatch& batch, int begin, int end);
};

//! Those compiled for an instruction set that `has_instruction_set` affirms.
const ViewKernels& view_kernels(InstructionSet set);

//! Follows the rays of an image on all threads of the processor; see FollowBatch.
void follow_rays(const FollowBatch& batch);

}  // namespace ergodome
