# Optional CUDA. Without a usable toolkit only the CPU kernels are built, and nothing else changes.
#
#   ergodome_add_cuda_sources(<target> <file.cu>...)
#
# adds the sources if CUDA is available and defines ERGODOME_HAVE_CUDA=1 on <target> and its
# dependents; does nothing otherwise. The runtime is linked statically, so a program with CUDA
# starts on a machine without driver or GPU.
#
#   ergodome_compile_for_gpus(<target> <file.cpp>...)
#
# adds sources that register kernels (kernels/launch/register.h) a second time, as CUDA.
set(ERGODOME_HAVE_CUDA OFF)

if(ERGODOME_CUDA AND NOT ERGODOME_SANITIZE)
  include(CheckLanguage)
  if(NOT CMAKE_CUDA_COMPILER AND NOT DEFINED ENV{CUDACXX})
    find_program(ERGODOME_NVCC nvcc HINTS "$ENV{CUDA_PATH}/bin" /usr/local/cuda/bin /opt/cuda/bin)
    mark_as_advanced(ERGODOME_NVCC)
    if(ERGODOME_NVCC)
      set(ENV{CUDACXX} "${ERGODOME_NVCC}")
    endif()
  endif()
  check_language(CUDA)
  if(CMAKE_CUDA_COMPILER)
    include(ErgodomeCudaLanguage)
    if(CMAKE_CUDA_COMPILER_VERSION VERSION_LESS 12.0)
      message(STATUS "Ergodome: CUDA ${CMAKE_CUDA_COMPILER_VERSION} has no C++20; 12.0 or newer is needed")
    else()
      find_package(CUDAToolkit REQUIRED)
      set(ERGODOME_HAVE_CUDA ON)
    endif()
  endif()
endif()
message(STATUS "Ergodome: CUDA kernels ${ERGODOME_HAVE_CUDA}")

function(ergodome_add_cuda_sources target)
  if(ERGODOME_HAVE_CUDA)
    target_sources(${target} PRIVATE ${ARGN})
    set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "${ERGODOME_CUDA_OPTIONS}")
    target_compile_definitions(${target} PUBLIC ERGODOME_HAVE_CUDA=1)
    target_link_libraries(${target} PUBLIC CUDA::cudart_static)
  endif()
endfunction()

function(ergodome_compile_for_gpus target)
  foreach(source IN LISTS ARGN)
    string(REGEX REPLACE "\\.cpp$" ".cu" as_cuda "${CMAKE_CURRENT_BINARY_DIR}/cuda/${source}")
    file(RELATIVE_PATH include "${PROJECT_SOURCE_DIR}" "${CMAKE_CURRENT_SOURCE_DIR}/${source}")
    file(CONFIGURE OUTPUT "${as_cuda}" CONTENT "#include \"${include}\"\n")
    ergodome_add_cuda_sources(${target} "${as_cuda}")
  endforeach()
endfunction()
