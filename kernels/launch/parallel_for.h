#pragma once

#include <functional>

namespace ergodome {

//! Number of CPU threads that launches use: the processor's, or ERGODOME_THREADS.
int thread_count();

//! Calls body(begin, end) for chunks that cover [0, count) once, on all CPU threads; returns when all are done.
//!
//! `grain` is the size of a chunk. Chunks are handed out as threads get free, so uneven work balances. Small jobs run on the
//! calling thread. `body` must not throw.
void parallel_for(int count, int grain, const std::function<void(int, int)>& body);

}  // namespace ergodome
