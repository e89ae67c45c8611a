# Language level, warnings and sanitizers that all targets of the project share.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release)
endif()

add_library(ergodome_options INTERFACE)
add_library(ergodome::options ALIAS ergodome_options)
target_include_directories(ergodome_options INTERFACE "${PROJECT_SOURCE_DIR}")
target_compile_definitions(
  ergodome_options
  INTERFACE ERGODOME_VERSION="${PROJECT_VERSION}"
            # Enables bounds checks of the standard library except in release builds, where speed
            # matters.
            $<$<NOT:$<CONFIG:Release>>:_GLIBCXX_ASSERTIONS>)
target_compile_options(
  ergodome_options
  INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Wall
            -Wextra
            -Wpedantic
            # In unity builds, a parameter may shadow a constant of another file, and a private
            # member may have a type that is local to its file.
            $<IF:$<BOOL:${CMAKE_UNITY_BUILD}>,$<$<CXX_COMPILER_ID:GNU>:-Wshadow=local;-Wno-subobject-linkage>,-Wshadow>
            -Wconversion
            -Wno-sign-conversion
            # Lane masks are combined with & and |; with a single lane they are bool.
            $<$<CXX_COMPILER_ID:Clang>:-Wno-bitwise-instead-of-logical>
            -Wno-psabi
            # Exact results must be reproducible: contraction into FMA is allowed, value-changing
            # reassociation is not; square roots and similar functions need not set errno.
            -fno-math-errno>)
if(ERGODOME_WARNINGS_AS_ERRORS)
  target_compile_options(ergodome_options INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Werror>)
endif()

if(ERGODOME_SANITIZE)
  # Libraries keep their own optimized copies of inline functions. A statically linked program would
  # use those of its tests, which are not optimized (tests/CMakeLists.txt), and run many times
  # slower.
  set(BUILD_SHARED_LIBS ON)
  set(CMAKE_POSITION_INDEPENDENT_CODE ON)
  string(APPEND CMAKE_SHARED_LINKER_FLAGS " -Wl,-Bsymbolic-functions")
  # AddressSanitizer detects null pointers, wrapped pointers and pointers that leave their object
  # when they are used outside of any object. Checking them earlier would take a fifth of the time
  # of kernels; it would also find pointers that are never used or lead into another object. Tests
  # marked ERGODOME_UNCHECKED only call checked code.
  target_compile_options(
    ergodome_options
    INTERFACE "$<$<NOT:$<BOOL:$<TARGET_PROPERTY:ERGODOME_UNCHECKED>>>:-fsanitize=address,undefined;-fno-sanitize-recover=all;-fno-sanitize=null,object-size,pointer-overflow>"
              -fno-omit-frame-pointer)
  target_compile_definitions(ergodome_options INTERFACE ERGODOME_SANITIZED=1)
  target_link_options(ergodome_options INTERFACE -fsanitize=address,undefined)
endif()
