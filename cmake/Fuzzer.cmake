# palpable_fuzzer(NAME x SOURCES x_fuzz.cpp USES modules… LINKS libraries…): one libFuzzer program, build/fuzz/bin/fuzz_x.
# Its initial inputs are in fuzz/corpus/x/: small files that once caused a fault, and one valid file.
# The target palpable_fuzzers builds all of them.
add_custom_target(palpable_fuzzers)
function(palpable_fuzzer)
  cmake_parse_arguments(F "" "NAME" "SOURCES;USES;LINKS" ${ARGN})
  add_executable(fuzz_${F_NAME} ${F_SOURCES})
  foreach(used ${F_USES})
    target_link_libraries(fuzz_${F_NAME} PRIVATE palpable_${used})
  endforeach()
  target_link_libraries(fuzz_${F_NAME} PRIVATE palpable_options ${F_LINKS})
  target_compile_options(fuzz_${F_NAME} PRIVATE -fsanitize=fuzzer)
  target_link_options(fuzz_${F_NAME} PRIVATE -fsanitize=fuzzer)
  add_dependencies(palpable_fuzzers fuzz_${F_NAME})
endfunction()
