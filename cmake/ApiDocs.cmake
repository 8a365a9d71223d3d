# docs_api: the reference of the library's headers as HTML in BUILD/docs_api/html, where doxygen is installed (packages/docs.txt).
find_program(PALPABLE_DOXYGEN doxygen)
if(PALPABLE_DOXYGEN)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/Doxyfile.in ${CMAKE_BINARY_DIR}/Doxyfile @ONLY)
  add_custom_target(docs_api COMMAND ${PALPABLE_DOXYGEN} ${CMAKE_BINARY_DIR}/Doxyfile WORKING_DIRECTORY ${CMAKE_BINARY_DIR}
                    COMMENT "Writing the API reference to docs_api/html" VERBATIM)
endif()
