# palpable_catalogues(FOLDER): writes FOLDER/palpable/describe/catalogues.gen.hpp, which holds the program's sentences in the
# languages of web/languages/program. A changed catalogue configures anew.
function(palpable_catalogues folder)
  get_filename_component(root ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/.. ABSOLUTE)
  foreach(pair GERMAN:de SPANISH:es)
    string(REPLACE ":" ";" pair ${pair})
    list(GET pair 0 name)
    list(GET pair 1 code)
    set(file ${root}/web/languages/program/${code}.json)
    file(READ ${file} PALPABLE_${name})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  endforeach()
  configure_file(${root}/src/palpable/describe/catalogues.gen.hpp.in ${folder}/palpable/describe/catalogues.gen.hpp @ONLY)
endfunction()
