#pragma once

#include <functional>

// Parallel loops on the CPU.
namespace ergodome {

//! Returns the number of CPU threads that launches use: ERGODOME_THREADS if positive, otherwise
//! that of the hardware; clamped to 1 to 256. Determined once.
int thread_count();

//! Calls body(begin, end) for chunks that cover [0, count) once, on all CPU threads; returns when
//! all are done.
//!
//! `grain` is the size of a chunk. Free threads take the next chunk, so uneven work balances. If
//! there is only one chunk, it runs on the calling thread. `body` must not throw.
void parallel_for(int count, int grain, const std::function<void(int, int)>& body);

}  // namespace ergodome
