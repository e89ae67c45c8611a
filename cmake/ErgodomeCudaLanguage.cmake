# Enables CUDA with the settings that the project and the standalone GPU check share.
if(NOT DEFINED CMAKE_CUDA_ARCHITECTURES AND NOT DEFINED ENV{CUDAARCHS})
  # Machine code for Turing to Hopper, and PTX of the newest architecture for later GPUs.
  set(CMAKE_CUDA_ARCHITECTURES 75-real 80-real 89-real 90)
endif()
set(CMAKE_CUDA_RUNTIME_LIBRARY Static)
enable_language(CUDA)
# CMake 3.25 does not know that nvcc 12 and newer support C++20.
if(NOT CMAKE_CUDA20_STANDARD_COMPILE_OPTION AND CMAKE_CUDA_COMPILER_VERSION VERSION_GREATER_EQUAL 12.0)
  set(CMAKE_CUDA20_STANDARD_COMPILE_OPTION "-std=c++20")
  set(CMAKE_CUDA20_EXTENSION_COMPILE_OPTION "-std=c++20")
endif()
set(CMAKE_CUDA_STANDARD 20)
set(CMAKE_CUDA_STANDARD_REQUIRED ON)

set(ERGODOME_CUDA_OPTIONS
    --expt-relaxed-constexpr
    --Werror=all-warnings
    # Two architectures at a time: with more cores than files, the slowest file takes half the time.
    --threads=2
    # GLM marks defaulted functions as device code, for which nvcc prints a remark at every
    # inclusion.
    --diag-suppress=20012
    -Xcompiler=-Wall,-Wextra,-Wno-psabi)
