# In builds with tests but without fuzzers, these are compiled all the same, as one object that nothing links: otherwise nobody
# notices when a parser's functions have changed.
file(GLOB fuzzers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/fuzz/*_fuzz.cpp)
set(text "")
foreach(fuzzer ${fuzzers})
  get_filename_component(name ${fuzzer} NAME_WE)
  string(APPEND text "#define LLVMFuzzerTestOneInput ${name}\n#include \"${fuzzer}\"\n#undef LLVMFuzzerTestOneInput\n")
endforeach()
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/all_fuzzers.cpp CONTENT "${text}" @ONLY)
add_library(palpable_fuzzer_sources OBJECT ${PROJECT_BINARY_DIR}/generated/all_fuzzers.cpp)
target_include_directories(palpable_fuzzer_sources PRIVATE ${PROJECT_SOURCE_DIR}/src ${PROJECT_BINARY_DIR}/generated)
target_link_libraries(palpable_fuzzer_sources PRIVATE palpable_options fmt::fmt nlohmann_json::nlohmann_json)
add_dependencies(palpable_fuzzer_sources palpable_page_messages)
# To include sources would be a finding of clang-tidy.
set_target_properties(palpable_fuzzer_sources PROPERTIES CXX_CLANG_TIDY "")
