# Language level, warnings and sanitizers that every target of the project shares.
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
            # Bounds checks of the standard library, wherever speed is not what is measured.
            $<$<NOT:$<CONFIG:Release>>:_GLIBCXX_ASSERTIONS>)
target_compile_options(
  ergodome_options
  INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Wall
            -Wextra
            -Wpedantic
            # Where several files are compiled as one, a parameter may bear the name of another file's constant, and what a class keeps
            # to itself may be of a file's own type.
            $<IF:$<BOOL:${CMAKE_UNITY_BUILD}>,$<$<CXX_COMPILER_ID:GNU>:-Wshadow=local;-Wno-subobject-linkage>,-Wshadow>
            -Wconversion
            -Wno-sign-conversion
            # Masks of lanes are joined by & and |, and are bool where there is one lane.
            $<$<CXX_COMPILER_ID:Clang>:-Wno-bitwise-instead-of-logical>
            -Wno-psabi
            # Exact results must not depend on the compiler's mood: contraction into FMA is fine, value-changing
            # reassociation is not; square roots and the like need no errno.
            -fno-math-errno>)
if(ERGODOME_WARNINGS_AS_ERRORS)
  target_compile_options(ergodome_options INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Werror>)
endif()

if(ERGODOME_SANITIZE)
  # Libraries keep to their own, optimized, copies of inline functions: a program linked as one takes those of its tests, which are not
  # (tests/CMakeLists.txt), and is many times slower.
  set(BUILD_SHARED_LIBS ON)
  set(CMAKE_POSITION_INDEPENDENT_CODE ON)
  string(APPEND CMAKE_SHARED_LINKER_FLAGS " -Wl,-Bsymbolic-functions")
  # Pointers that are null, go round or leave their object are seen by AddressSanitizer where they are used outside of any object. To ask before
  # takes a fifth of the time of kernels, and would find those, too, that are never used or lead into another object.
  # Tests that are marked ERGODOME_UNCHECKED only call what is checked.
  target_compile_options(
    ergodome_options
    INTERFACE "$<$<NOT:$<BOOL:$<TARGET_PROPERTY:ERGODOME_UNCHECKED>>>:-fsanitize=address,undefined;-fno-sanitize-recover=all;-fno-sanitize=null,object-size,pointer-overflow>"
              -fno-omit-frame-pointer)
  target_compile_definitions(ergodome_options INTERFACE ERGODOME_SANITIZED=1)
  target_link_options(ergodome_options INTERFACE -fsanitize=address,undefined)
endif()
