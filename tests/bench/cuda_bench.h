#pragma once

namespace ergodome {

//! Adds the benchmarks of frames on a GPU, where there is one.
void add_cuda_benchmarks();

}  // namespace ergodome
