# Registers the tests of GoogleTest programs with CTest.

set(ERGODOME_SUITES_LEFT_OUT "" CACHE STRING "Suites of tests that CTest does not run")

# ergodome_discover_tests(<target> [LONG] [CHECKED]) groups every few suites into one CTest test,
# named after them, because starting a program and loading its sky takes longer than most suites.
# LONG: the suites start first, so that no core waits for them at the end.
# CHECKED: sanitizes the code of the test program itself, for tests of code in headers. Other test
# programs are not sanitized, which saves a third of their compile time; the libraries that they
# call are.
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
