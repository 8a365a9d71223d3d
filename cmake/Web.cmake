# Builds the web page: npm ci, the message definitions in C++, the build with Vite, and the result as a C++ source.
#   palpable_web(DEFINITIONS header-variable ASSETS source-variable)
# Installation scripts of npm packages are disabled; no package needs one.
# A step is repeated only if its inputs have changed. npm needs the network (or a filled cache) the first time only.
function(palpable_web)
  cmake_parse_arguments(W "" "DEFINITIONS;ASSETS" "" ${ARGN})
  set(web ${PROJECT_SOURCE_DIR}/web)
  set(out ${CMAKE_BINARY_DIR}/web)
  find_program(PALPABLE_NODE NAMES node nodejs)
  find_program(PALPABLE_NPM npm)
  if(NOT PALPABLE_NODE OR NOT PALPABLE_NPM)
    message(FATAL_ERROR "Palpable's page is built with Node.js 18 or newer and npm: install them (Debian: apt install nodejs npm)")
  endif()

  # All build folders share one folder of packages; its stamp file is inside it, so that both are deleted together. ./run
  # and ./test use the same stamp.
  set(packages ${web}/node_modules/.palpable-lock)
  add_custom_command(
    OUTPUT ${packages}
    COMMAND sh -c "cmp -s package-lock.json node_modules/.palpable-lock || '${PALPABLE_NPM}' ci --ignore-scripts --no-audit --no-fund --loglevel=error || { echo \"palpable: the page's packages could not be fetched: npm needs the network, or a filled cache, the first time\"; exit 1; }"
    COMMAND ${CMAKE_COMMAND} -E copy package-lock.json node_modules/.palpable-lock
    DEPENDS ${web}/package-lock.json
    WORKING_DIRECTORY ${web}
    COMMENT "Installing the page's packages (npm ci)"
    VERBATIM)

  set(definitions ${CMAKE_BINARY_DIR}/generated/palpable/page/protocol.gen.hpp)
  add_custom_command(
    OUTPUT ${definitions}
    COMMAND ${PALPABLE_NODE} ${web}/scripts/protocol.mjs --cpp ${definitions}
    DEPENDS ${web}/protocol.json ${web}/scripts/protocol.mjs
    COMMENT "Making the page's messages for C++"
    VERBATIM)

  # A new file changes its folder, and a changed folder triggers a new configuration. Unlike CONFIGURE_DEPENDS, this takes
  # no time if nothing has changed.
  file(GLOB_RECURSE sources LIST_DIRECTORIES true ${web}/src/* ${web}/public/*)
  list(FILTER sources EXCLUDE REGEX "/generated|\\.test\\.ts$")
  set(folders ${web}/src ${web}/public)
  foreach(source ${sources})
    if(IS_DIRECTORY ${source})
      list(APPEND folders ${source})
      list(REMOVE_ITEM sources ${source})
    endif()
  endforeach()
  set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${folders})
  set(assets ${out}/assets.gen.cpp)
  add_custom_command(
    OUTPUT ${assets}
    COMMAND ${PALPABLE_NPM} run --silent build -- --outDir ${out}/dist --emptyOutDir --logLevel warn
    COMMAND ${PALPABLE_NODE} ${web}/scripts/embed.mjs ${out}/dist ${assets}
    DEPENDS ${packages} ${sources} ${web}/languages/de.json ${web}/languages/es.json ${web}/index.html ${web}/shelf.html ${web}/protocol.json ${web}/scripts/protocol.mjs
            ${web}/scripts/embed.mjs ${web}/vite.config.ts ${web}/tsconfig.json
    WORKING_DIRECTORY ${web}
    COMMENT "Building the page"
    VERBATIM)
  set(${W_DEFINITIONS} ${definitions} PARENT_SCOPE)
  set(${W_ASSETS} ${assets} PARENT_SCOPE)
endfunction()
