# Fails if the table of docs/architecture.md is not that of Layers.cmake.
# Run: cmake -DDOCUMENT=<docs/architecture.md> -P cmake/CheckArchitecture.cmake
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/Layers.cmake)
file(READ ${DOCUMENT} text)
foreach(module ${PALPABLE_MODULES})
  list(JOIN PALPABLE_MAY_USE_${module} ", " uses)
  if(NOT text MATCHES "\n\\| `${module}` \\|[^\n]*\\| ${uses} \\|\n")
    message(SEND_ERROR "${DOCUMENT}: the row of ${module} must end with | ${uses} |")
  endif()
endforeach()
