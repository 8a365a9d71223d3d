# Included by CTest for each program of palpable_discover_suites, with program, prefix, timeout and suites (the file to write).
# A suite whose every test was skipped is a skipped test.
if(NOT EXISTS "${program}")
  file(WRITE "${suites}" "add_test([=[${prefix}_NOT_BUILT]=] [=[${prefix}_NOT_BUILT]=])\n")
elseif("${program}" IS_NEWER_THAN "${suites}")
  execute_process(COMMAND "${program}" --gtest_list_tests OUTPUT_VARIABLE listed RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${program} --gtest_list_tests ends with ${result}")
  endif()
  # The lines of suites: Suite. or Values/Suite. or Suite/0. with a comment behind it.
  string(REGEX MATCHALL "\n[A-Za-z0-9_/]+\\." lines "\n${listed}")
  set(names)
  foreach(line IN LISTS lines)
    string(REGEX REPLACE "[\n.]" "" suite "${line}")
    string(REGEX REPLACE "^([A-Za-z0-9_]*/)?([A-Za-z_][A-Za-z0-9_]*)(/[0-9]+)?$" "\\2" name "${suite}")
    list(APPEND names "${name}")
    string(APPEND filter_${name} ":${suite}.*")
  endforeach()
  list(REMOVE_DUPLICATES names)
  set(script "")
  foreach(name IN LISTS names)
    string(SUBSTRING "${filter_${name}}" 1 -1 filter)
    string(APPEND script "add_test([=[${prefix}.${name}]=] [=[${program}]=] [=[--gtest_filter=${filter}]=])\n"
                         "set_tests_properties([=[${prefix}.${name}]=] PROPERTIES TIMEOUT ${timeout} SKIP_REGULAR_EXPRESSION "
                         "[=[\\[  PASSED  \\] 0 tests\\..\\[  SKIPPED \\]]=])\n")
    unset(filter_${name})
  endforeach()
  file(WRITE "${suites}" "${script}")
endif()
