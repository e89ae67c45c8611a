#pragma once

// Registration of benchmarks that need a GPU.
namespace ergodome {

//! Registers the benchmarks of frames on a GPU, if there is one.
void add_cuda_benchmarks();

//! Registers the benchmarks of objects by traced rays, if there is a GPU.
void add_cuda_object_benchmarks();

//! Registers the benchmarks of projectors that show frames rendered by the GPU, if there is a GPU.
void add_cuda_projector_benchmarks();

//! Registers the benchmarks of a headset whose panoramas are rendered by the GPU. Call it only if
//! there is a GPU.
void add_cuda_headset_benchmarks();

}  // namespace ergodome
