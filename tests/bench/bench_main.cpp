#include <benchmark/benchmark.h>

#include "render/backend/cached_memory.h"
#include "tests/bench/cuda_bench.h"

//! Runs benchmarks with the same allocator settings as the program, which keeps freed memory.
int main(int argc, char** argv) {
  ergodome::keep_freed_memory();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) {
    return 1;
  }
  ergodome::add_cuda_benchmarks();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
