# Compiler options for all targets of the project, as the interface library palpable_options.
add_library(palpable_options INTERFACE)
target_compile_features(palpable_options INTERFACE cxx_std_20)
target_compile_options(palpable_options INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wshadow)
# The same arithmetic on every machine: no fused multiply-add, since a result must not depend on the compiler's choice.
target_compile_options(palpable_options INTERFACE -ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # At -O3 this compiler wrongly reports an overlapping copy for "text" + std::string: https://gcc.gnu.org/bugzilla/show_bug.cgi?id=105651
  target_compile_options(palpable_options INTERFACE -Wno-restrict)
endif()
if(PALPABLE_WERROR)
  target_compile_options(palpable_options INTERFACE -Werror)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # Warnings that depend on the optimiser are shown but do not stop a build: those of g++ 12 are often wrong, and differ
    # between levels of optimisation.
    target_compile_options(palpable_options INTERFACE -Wno-error=maybe-uninitialized -Wno-error=array-bounds
                           -Wno-error=stringop-overflow -Wno-error=stringop-overread -Wno-error=free-nonheap-object)
  endif()
endif()
# g++ looks through all of its memory, precompiled headers included, whenever it has grown by some share; for groups of sources
# this takes a tenth of the time. Where there is memory for three of them at once, it does so from 1.5 GB on only.
if(PALPABLE_UNITY AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  cmake_host_system_information(RESULT memory_MiB QUERY TOTAL_PHYSICAL_MEMORY)
  if(memory_MiB GREATER 12000)
    add_compile_options(--param=ggc-min-heapsize=1500000)
  endif()
endif()
# clang calls it a shadow, too, when a local name is that of a neighbour in the group. Builds without groups find real ones.
if(PALPABLE_UNITY AND CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  target_compile_options(palpable_options INTERFACE -Wno-shadow)
endif()
# Recordings contain the identifier of the build that wrote them.
add_link_options(-Wl,--build-id)
find_package(Threads REQUIRED)
target_link_libraries(palpable_options INTERFACE Threads::Threads)

# Hardening: memory errors end the program instead of being exploitable. Not with sanitizers, which detect more.
if(PALPABLE_HARDEN AND NOT PALPABLE_SANITIZE AND NOT PALPABLE_COVERAGE)
  add_compile_options(-fstack-protector-strong -fPIE)
  if(NOT CMAKE_BUILD_TYPE STREQUAL "Debug")
    # Needs an optimised build.
    add_compile_options(-U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=2)
  endif()
  add_link_options(-pie -Wl,-z,relro -Wl,-z,now)
endif()

if(PALPABLE_SANITIZE)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # With a sanitizer, g++ 12 wrongly reports std::variant as maybe uninitialized; other builds keep the warning.
    target_compile_options(palpable_options INTERFACE -Wno-maybe-uninitialized)
  endif()
  add_compile_options(-fsanitize=${PALPABLE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  string(REPLACE "fuzzer-no-link," "" palpable_link_sanitize "${PALPABLE_SANITIZE}")
  add_link_options(-fsanitize=${palpable_link_sanitize})
  add_compile_definitions(PALPABLE_SANITIZED)
endif()
if(PALPABLE_COVERAGE)
  add_compile_options(--coverage)
  add_link_options(--coverage)
endif()
if(PALPABLE_TIDY)
  find_program(PALPABLE_CLANG_TIDY clang-tidy REQUIRED)
  set(CMAKE_CXX_CLANG_TIDY ${PALPABLE_CLANG_TIDY} --quiet)
endif()
find_program(PALPABLE_CCACHE ccache)
if(PALPABLE_CCACHE AND NOT PALPABLE_TIDY)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1
                                  CCACHE_SLOPPINESS=time_macros,pch_defines ${PALPABLE_CCACHE})
endif()
