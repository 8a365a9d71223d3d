# palpable_test_program(TARGET [most]): what the programs of tests have in common. Optimised builds compile their sources with -O1
# and at most the line numbers of debug information: the tests' own code is not hot, and takes half of a build from nothing.
# Complete builds (PALPABLE_UNITY) compile the tests of a room in groups (half of their time), so that names in their unnamed
# namespaces are unique within a room. They are linked by lld where it is installed, in a quarter of the time: they are 40
# programs of 25 to 90 MB.
include(${CMAKE_CURRENT_LIST_DIR}/CommonHeaders.cmake)

# How many sources complete builds compile together, where a module states no other number.
set(PALPABLE_GROUPS_OF 16)
find_program(PALPABLE_LLD ld.lld)
mark_as_advanced(PALPABLE_LLD)
function(palpable_test_program target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release,RelWithDebInfo>:-O1>)
  if(NOT PALPABLE_UNITY)
    target_compile_options(${target} PRIVATE $<$<CONFIG:RelWithDebInfo>:-g1>)
    return()
  endif()
  target_link_libraries(${target} PRIVATE GTest::gmock)
  if(PALPABLE_LLD)
    target_link_options(${target} PRIVATE -fuse-ld=lld)
  endif()
  palpable_common_headers(${target} TEST)
  set(most ${PALPABLE_GROUPS_OF})
  if(ARGC GREATER 1)
    set(most ${ARGV1})
  endif()
  palpable_group_tests(${target} ${most})
endfunction()

# Sources of one folder are compiled together, at most `most` at a time.
function(palpable_group_tests target most)
  get_target_property(sources ${target} SOURCES)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  foreach(source ${sources})
    get_filename_component(room ${source} DIRECTORY)
    string(MAKE_C_IDENTIFIER "tests_${room}" room)
    math(EXPR count_${room} "0${count_${room}} + 1")
    math(EXPR group "(${count_${room}} - 1) / ${most}")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${room}_${group})
  endforeach()
endfunction()
