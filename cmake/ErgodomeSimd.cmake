# Compiles one source for several instruction sets.
#
#   ergodome_add_simd_library(<target> [SOURCES <file>...] [CUDA <file>...] [LINK <library>...])
#
# compiles every source once per instruction set, with ERGO_TARGET set to its name (portable, avx2,
# avx512), and puts the objects into <target>, which is created as a static library if it does not
# exist. Sources after CUDA are also compiled for GPUs. ERGODOME_SIMD_PORTABLE=1,
# ERGODOME_SIMD_AVX2=1 and ERGODOME_SIMD_AVX512=1 on <target> and its dependents state which sets
# are built; the program picks one at run time. These sources must contain only code in
# `ergodome::ERGO_TARGET`: tests/check_instruction_sets enforces this.
option(ERGODOME_NATIVE "Build CPU kernels only for this machine's instruction set" OFF)

set(ERGODOME_SIMD_FLAGS_portable "")
set(ERGODOME_SIMD_FLAGS_avx2 -mavx2 -mfma -mf16c -mbmi2)
set(ERGODOME_SIMD_FLAGS_avx512
    -mavx512f -mavx512dq -mavx512bw -mavx512vl -mfma -mf16c -mbmi2 -mprefer-vector-width=512)

set(ERGODOME_SIMD_TARGETS portable)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
  list(APPEND ERGODOME_SIMD_TARGETS avx2)
  # Sanitizers multiply the compile time; two instruction sets already exercise the choice between them.
  if(NOT ERGODOME_SANITIZE)
    list(APPEND ERGODOME_SIMD_TARGETS avx512)
  endif()
endif()
if(ERGODOME_NATIVE AND EXISTS /proc/cpuinfo)
  file(STRINGS /proc/cpuinfo ERGODOME_CPU_FLAGS REGEX "^flags" LIMIT_COUNT 1)
  string(APPEND ERGODOME_CPU_FLAGS " ")
  set(ERGODOME_SIMD_TARGETS portable)
  if(ERGODOME_CPU_FLAGS MATCHES " avx2 " AND ERGODOME_CPU_FLAGS MATCHES " fma " AND ERGODOME_CPU_FLAGS MATCHES " bmi2 ")
    set(ERGODOME_SIMD_TARGETS avx2)
    if(ERGODOME_CPU_FLAGS MATCHES " avx512f " AND ERGODOME_CPU_FLAGS MATCHES " avx512dq " AND ERGODOME_CPU_FLAGS MATCHES " avx512bw "
       AND ERGODOME_CPU_FLAGS MATCHES " avx512vl ")
      set(ERGODOME_SIMD_TARGETS avx512)
    endif()
  endif()
endif()
message(STATUS "Ergodome: CPU kernels ${ERGODOME_SIMD_TARGETS}")

function(ergodome_add_simd_library target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;CUDA;LINK")
  if(NOT TARGET ${target})
    add_library(${target})
    set_target_properties(${target} PROPERTIES UNITY_BUILD OFF)
  endif()
  foreach(simd IN LISTS ERGODOME_SIMD_TARGETS)
    set(objects ${target}_${simd})
    if(NOT TARGET ${objects})
      add_library(${objects} OBJECT)
      # No unity build: each file defines its own launch function, and takes long to compile anyway.
      set_target_properties(${objects} PROPERTIES UNITY_BUILD OFF)
      target_compile_definitions(${objects} PRIVATE ERGO_TARGET=${simd})
      # Optimized even in debug builds, because unoptimized SIMD wrappers are about fifty times
      # slower. FMA contraction is allowed.
      set(optimization $<IF:$<CONFIG:Release>,-O3,-O2>)
      if(ERGODOME_SANITIZE AND simd STREQUAL "portable" AND "avx2" IN_LIST ERGODOME_SIMD_TARGETS)
        # Where the machine supports AVX2, only the tests of the choice of instruction sets run this
        # one. Optimizing it would take four times as long as compiling it unoptimized.
        set(optimization -O0)
      endif()
      target_compile_options(
        ${objects} PRIVATE ${ERGODOME_SIMD_FLAGS_${simd}} -ffp-contract=fast ${optimization})
      target_link_libraries(${objects} PRIVATE ergodome::options)
      target_sources(${target} PRIVATE $<TARGET_OBJECTS:${objects}>)
      string(TOUPPER ${simd} name)
      target_compile_definitions(${target} PUBLIC ERGODOME_SIMD_${name}=1)
      if(NOT simd STREQUAL "portable")
        set_property(GLOBAL APPEND PROPERTY ERGODOME_SIMD_OBJECTS ${objects})
      endif()
    endif()
    target_sources(${objects} PRIVATE ${arg_SOURCES} ${arg_CUDA})
    target_link_libraries(${objects} PRIVATE ${arg_LINK})
  endforeach()
  if(ERGODOME_HAVE_CUDA AND arg_CUDA)
    ergodome_compile_for_gpus(${target} ${arg_CUDA})
  endif()
endfunction()
