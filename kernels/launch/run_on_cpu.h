#pragma once

#include "kernels/launch/check_numbers.h"
#include "kernels/launch/kernel_table.h"
#include "kernels/launch/parallel_for.h"
#include "kernels/launch/work_counter.h"

// Shared by all launches of kernels.
namespace ergodome {

//! Number of kernel indices that a thread takes at a time: tens of microseconds of work, so that
//! uneven rays balance.
inline constexpr int grain = 32;
//! The same for the rays of a grid, of which there are only hundreds and which cost more each.
inline constexpr int grid_grain = 4;

inline int index_count(int elements, int lanes) { return elements > 0 ? (elements - 1) / lanes + 1 : 0; }

inline const KernelTable& active_table() { return kernel_table(active_instruction_set()); }

//! Runs a CPU kernel over `elements`, with `lanes` elements per index, on all threads.
template <class Batch>
void run_on_cpu(void (*kernel)(const Batch&, int, int), const Batch& batch, int elements, int lanes,
                int chunk = grain) {
  parallel_for(index_count(elements, lanes), chunk, [&](int begin, int end) { kernel(batch, begin, end); });
}

//! Ends a launch: checks the outputs if numbers are checked.
template <class Batch>
void finish(const WorkCounter& counter, Backend backend, const Batch& batch) {
  if (numbers_are_checked()) {
    check_outputs(counter.name(), backend, batch);
  }
}

}  // namespace ergodome
