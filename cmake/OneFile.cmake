# Builds the page that `palpable export SCENE -o x.html` fills: the page's TypeScript, and the touch as WebAssembly by
# emscripten. Without emscripten it is left out, and `export` says so.
#   palpable_one_file_page(PAGE source-variable)
# All build folders share the WebAssembly part (build/wasm), as they share the page's packages.
function(palpable_one_file_page)
  cmake_parse_arguments(O "" "PAGE" "" ${ARGN})
  set(web ${PROJECT_SOURCE_DIR}/web)
  set(module ${PROJECT_SOURCE_DIR}/src/palpable/onefile)
  set(wasm ${CMAKE_BINARY_DIR}/web/touch.wasm)
  set(page ${CMAKE_BINARY_DIR}/web/onefile.html)
  find_program(PALPABLE_EMXX em++)
  find_file(PALPABLE_EMSCRIPTEN_TOOLCHAIN Emscripten.cmake PATHS /usr/share/emscripten $ENV{EMSDK}/upstream/emscripten
            PATH_SUFFIXES cmake/Modules/Platform)
  if(PALPABLE_EMXX AND PALPABLE_EMSCRIPTEN_TOOLCHAIN)
    # The inner build knows which of these its sources include.
    file(GLOB_RECURSE sources ${PROJECT_SOURCE_DIR}/src/palpable/*.hpp ${module}/wasm/*)
    foreach(used core models formats device haptics describe session page onefile)
      file(GLOB_RECURSE more ${PROJECT_SOURCE_DIR}/src/palpable/${used}/*.cpp)
      list(APPEND sources ${more})
    endforeach()
    list(FILTER sources EXCLUDE REGEX "_test\\.cpp$|/test_")
    set(need required)
    if(NOT PALPABLE_TESTS)
      # ./run goes on without it.
      set(need optional)
    endif()
    add_custom_command(
      OUTPUT ${wasm}
      COMMAND ${module}/wasm/build.sh ${PALPABLE_EMSCRIPTEN_TOOLCHAIN} ${CMAKE_GENERATOR} ${PALPABLE_NODE} ${need} ${wasm}
      DEPENDS ${sources} ${web}/languages/program/de.json ${web}/languages/program/es.json ${module}/../describe/catalogues.gen.hpp.in ${web}/protocol.json ${web}/scripts/protocol.mjs
      COMMENT "Compiling the touch to WebAssembly (emscripten)"
      VERBATIM)
    file(GLOB_RECURSE scripts ${web}/src/*)
    list(FILTER scripts EXCLUDE REGEX "/generated|\\.test\\.ts$")
    add_custom_command(
      OUTPUT ${page}
      COMMAND ${PALPABLE_NPM} run --silent build:onefile -- --outDir ${CMAKE_BINARY_DIR}/web/onefile --emptyOutDir --logLevel warn
      COMMAND ${PALPABLE_NODE} ${web}/scripts/one_file.mjs ${CMAKE_BINARY_DIR}/web/onefile ${wasm} ${page}
      DEPENDS ${wasm} ${web}/node_modules/.palpable-lock ${scripts} ${web}/languages/de.json ${web}/languages/es.json ${web}/index.html ${web}/protocol.json
              ${web}/scripts/one_file.mjs ${web}/vite.onefile.config.ts ${web}/public/favicon.svg
      WORKING_DIRECTORY ${web}
      COMMENT "Building the one-file page"
      VERBATIM)
  else()
    message(STATUS "There is no emscripten: `palpable export SCENE -o x.html` is left out (Debian: apt install emscripten)")
    file(CONFIGURE OUTPUT ${page} CONTENT "")
  endif()
  set(source ${CMAKE_BINARY_DIR}/web/page_template.gen.cpp)
  configure_file(${module}/page_template.cpp.in ${source} @ONLY)
  # The assembler reads the page: the compiler does not see the dependency.
  set_source_files_properties(${source} PROPERTIES OBJECT_DEPENDS ${page} SKIP_UNITY_BUILD_INCLUSION ON)
  set(${O_PAGE} ${source} PARENT_SCOPE)
endfunction()
