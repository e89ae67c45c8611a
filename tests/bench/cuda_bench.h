#pragma once

namespace ergodome {

//! Adds the benchmarks of frames on a GPU, where there is one.
void add_cuda_benchmarks();

//! Those of objects by rays, where there is a GPU.
void add_cuda_object_benchmarks();

//! Those of projectors that show what CUDA has rendered; only where there is a GPU.
void add_cuda_projector_benchmarks();

}  // namespace ergodome
