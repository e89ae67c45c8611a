# Writes a CTest file with a test for each suite of a GoogleTest program: cmake -D PROGRAM=... -D OUTPUT=... -D LONG=... -P
# ListTestSuites.cmake
execute_process(
  COMMAND "${PROGRAM}" --gtest_list_tests
  OUTPUT_VARIABLE listing
  RESULT_VARIABLE result
  TIMEOUT 120)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} does not list its tests: ${result}\n${listing}")
endif()
# Suites start their line, tests are indented; what follows # are the suite's types.
string(REGEX MATCHALL "(^|\n)[A-Za-z0-9_/]+\\." suites "${listing}")
if(NOT suites)
  message(FATAL_ERROR "${PROGRAM} has no tests")
endif()
set(lines "")
foreach(suite IN LISTS suites)
  string(STRIP "${suite}" suite)
  string(REGEX REPLACE "\\.$" "" suite "${suite}")
  string(APPEND lines "add_test([=[${suite}]=] [=[${PROGRAM}]=] [=[--gtest_filter=${suite}.*]=])\n")
  if(LONG)
    string(APPEND lines "set_tests_properties([=[${suite}]=] PROPERTIES COST 60)\n")
  endif()
endforeach()
file(WRITE "${OUTPUT}" "${lines}")
