# palpable_discover_suites(TARGET PREFIX TIMEOUT): one test of CTest for each suite of a GoogleTest program, PREFIX.SUITE. Each
# start of a program loads its libraries (20 to 450 ms), so a start for each of 3000 tests would take a tenth of a test run.
# Values and types of a parameterised suite are one test too. The suites are read when CTest starts, and again if the program is newer.
function(palpable_discover_suites target prefix timeout)
  set(include_file ${CMAKE_CURRENT_BINARY_DIR}/${target}_suites.cmake)
  file(GENERATE OUTPUT ${include_file} CONTENT "\
set(program \"$<TARGET_FILE:${target}>\")
set(prefix \"${prefix}\")
set(timeout \"${timeout}\")
set(suites \"${CMAKE_CURRENT_BINARY_DIR}/${target}_suites_list.cmake\")
include(\"${PROJECT_SOURCE_DIR}/cmake/ListSuites.cmake\")
include(\"\${suites}\" OPTIONAL)
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${include_file})
endfunction()
