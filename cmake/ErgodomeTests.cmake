# How CTest knows the tests of a GoogleTest program.

set(ERGODOME_SUITES_LEFT_OUT "" CACHE STRING "Suites of tests that CTest does not run")

# Every few suites are one test, which is named by them: to start a program and load its sky takes longer than most.
# ergodome_discover_tests(<target> [LONG] [CHECKED]): suites of a program that is LONG start first, so that no core waits for them at the end.
# Under the sanitizers the tests' own code is as it is, which takes a third less to compile: what they call is checked where it is compiled, in the
# libraries. A program that is CHECKED has what it calls in headers.
function(ergodome_discover_tests target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "LONG;CHECKED" "" "")
  if(NOT arg_CHECKED)
    set_target_properties(${target} PROPERTIES ERGODOME_UNCHECKED ON)
  endif()
  set(suites "${CMAKE_CURRENT_BINARY_DIR}/${target}_suites.cmake")
  add_custom_command(
    TARGET ${target}
    POST_BUILD
    COMMAND "${CMAKE_COMMAND}" -D "PROGRAM=$<TARGET_FILE:${target}>" -D "OUTPUT=${suites}" -D
            "LONG=${arg_LONG}" -D "LEFT_OUT=${ERGODOME_SUITES_LEFT_OUT}" -P "${PROJECT_SOURCE_DIR}/cmake/ListTestSuites.cmake"
    BYPRODUCTS "${suites}"
    VERBATIM)
  set(include_file "${CMAKE_CURRENT_BINARY_DIR}/${target}_include.cmake")
  file(WRITE "${include_file}" "if(EXISTS \"${suites}\")\n  include(\"${suites}\")\nelse()\n"
                               "  add_test(${target}_NOT_BUILT ${target}_NOT_BUILT)\nendif()\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES "${include_file}")
endfunction()
