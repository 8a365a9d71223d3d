# palpable_common_headers(TARGET KIND): in builds that compile in groups (PALPABLE_UNITY), the headers that most sources include are
# compiled once for all targets of a kind, which takes a quarter of a build's time off; the other builds (dev, the sanitizers,
# clang-tidy) do not, so that a missing include does not stay hidden. A kind is a level of optimisation, since the compiler
# uses such headers only where its options are the same: MODULE, NOT_HOT (-O1), TEST (-O1, with GoogleTest).
set(PALPABLE_HEADERS <algorithm> <array> <atomic> <chrono> <cmath> <cstdint> <cstring> <filesystem> <functional> <limits> <map> <memory> <mutex>
                     <numbers> <numeric> <optional> <random> <set> <span> <string> <string_view> <thread> <utility> <variant> <vector>
                     <fmt/format.h>)

function(palpable_common_headers target kind)
  if(NOT PALPABLE_UNITY)
    return()
  endif()
  string(TOLOWER "palpable_${kind}_headers" holder)
  if(NOT TARGET ${holder})
    set(source ${PROJECT_BINARY_DIR}/generated/${holder}.cpp)
    file(WRITE ${source} "// Holds nothing: its precompiled headers are used by other targets.\n")
    add_library(${holder} OBJECT ${source})
    target_link_libraries(${holder} PRIVATE palpable_options fmt::fmt)
    if(NOT kind STREQUAL MODULE)
      target_compile_options(${holder} PRIVATE $<$<CONFIG:Release,RelWithDebInfo>:-O1>)
    endif()
    target_precompile_headers(${holder} PRIVATE ${PALPABLE_HEADERS})
    if(kind STREQUAL TEST)
      target_link_libraries(${holder} PRIVATE GTest::gmock)
      target_precompile_headers(${holder} PRIVATE <gmock/gmock.h> <gtest/gtest.h>)
    endif()
  endif()
  target_precompile_headers(${target} REUSE_FROM ${holder})
  # Those of fmt were compiled with this, and are refused where it differs.
  target_compile_definitions(${target} PRIVATE $<TARGET_PROPERTY:fmt::fmt,INTERFACE_COMPILE_DEFINITIONS>)
endfunction()
