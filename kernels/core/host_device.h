#pragma once

//! Marks functions that run on the host and on the device, and names the instruction set that this file is compiled for.
//!
//! ERGO_HD_RARE functions hold what few pictures need: on the host they stay functions, so that the others' loops stay short. On a device
//! a call would take registers from all.
//! ERGO_HD_CALLED functions stay functions: large ones that are read from several places and are not worth a copy for each.
//!
//! Inline code of `kernels/` lives in `ergodome::ERGO_TARGET`, an inline namespace: the same header compiled for AVX-512 and
//! for plain x86-64 in one program gives two functions with two names, so the linker can never hand AVX-512 code to a
//! processor without it. Plain data that crosses that border lives in `ergodome` itself.
#if defined(__CUDACC__)
#define ERGO_HD __host__ __device__ __forceinline__
#define ERGO_HD_RARE ERGO_HD
#define ERGO_HD_CALLED inline __host__ __device__ __noinline__
#else
#define ERGO_HD inline
#define ERGO_HD_RARE [[gnu::noinline]] inline
#define ERGO_HD_CALLED [[gnu::noinline]] inline
#endif

//! Asks the compiler to unroll the loop that follows: the order of a series and the stages of a method are constants.
//! Not under the sanitizers, whose checks in unrolled code take the compiler many minutes.
#if defined(ERGODOME_SANITIZED)
#define ERGO_UNROLL
#elif defined(__CUDA_ARCH__) || defined(__clang__)
#define ERGO_UNROLL _Pragma("unroll")
#elif defined(__CUDACC__)
#define ERGO_UNROLL
#else
#define ERGO_UNROLL _Pragma("GCC unroll 32")
#endif

#if !defined(ERGO_TARGET)
#define ERGO_TARGET portable
#endif
