# Writes a CTest file with a test for every few suites of a GoogleTest program, named by them:
#   cmake -D PROGRAM=... -D OUTPUT=... -D LONG=... -D LEFT_OUT=... -P ListTestSuites.cmake
# LEFT_OUT: suites that are skipped.

# Several, because loading OpenImageIO with its hundreds of libraries takes half a second, longer
# than most suites; few, so that two cores share the suites evenly.
set(suites_of_a_test 6)

execute_process(
  COMMAND "${PROGRAM}" --gtest_list_tests
  OUTPUT_VARIABLE listing
  RESULT_VARIABLE result
  TIMEOUT 120)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} does not list its tests: ${result}\n${listing}")
endif()
# Suites start at the beginning of a line, tests are indented; the types of a suite follow a #.
string(REGEX MATCHALL "(^|\n)[A-Za-z0-9_/]+\\." suites "${listing}")
if(NOT suites)
  message(FATAL_ERROR "${PROGRAM} has no tests")
endif()
list(TRANSFORM suites STRIP)
list(TRANSFORM suites REPLACE "\\.$" "")
list(REMOVE_ITEM suites ${LEFT_OUT})

set(lines "")
while(suites)
  list(SUBLIST suites 0 ${suites_of_a_test} some)
  list(REMOVE_ITEM suites ${some})
  list(JOIN some " " name)
  list(JOIN some ".*:" filter)
  string(APPEND lines "add_test([=[${name}]=] [=[${PROGRAM}]=] [=[--gtest_filter=${filter}.*]=])\n")
  if(LONG)
    string(APPEND lines "set_tests_properties([=[${name}]=] PROPERTIES COST 60)\n")
  endif()
endwhile()
file(WRITE "${OUTPUT}" "${lines}")
