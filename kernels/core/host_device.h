#pragma once

//! Marks functions that run on the host and on the device, and names the instruction set that this
//! file is compiled for.
//!
//! ERGO_HD_RARE functions contain code that few pictures need. On the host they are not inlined, so
//! that the loops of other pictures remain short. On a device they are inlined, because a call
//! would make the kernel need more registers for every picture. ERGO_HD_CALLED functions are never
//! inlined: they are large, and have several callers.
//!
//! Inline code of `kernels/` is in `ergodome::ERGO_TARGET`, an inline namespace. The same header
//! compiled for AVX-512 and for plain x86-64 in one program gives two functions with two names, so
//! the linker can never give AVX-512 code to a processor without it. Plain data that is shared
//! between the two is in `ergodome` itself.
#if defined(__CUDACC__)
#define ERGO_HD __host__ __device__ __forceinline__
#define ERGO_HD_RARE ERGO_HD
#define ERGO_HD_CALLED inline __host__ __device__ __noinline__
#else
#define ERGO_HD inline
#define ERGO_HD_RARE [[gnu::noinline]] inline
#define ERGO_HD_CALLED [[gnu::noinline]] inline
#endif

//! Makes the compiler unroll the next loop, whose length is a compile-time constant (the order of a
//! series, or the number of stages of a method). Disabled for sanitizers, whose checks in unrolled
//! code take the compiler many minutes.
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
