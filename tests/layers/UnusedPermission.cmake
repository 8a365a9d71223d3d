# Intentionally wrong: the table of the project with two unused permissions.
include(${CMAKE_CURRENT_LIST_DIR}/../../cmake/Layers.cmake)
list(APPEND PALPABLE_MAY_USE_voice models)
list(APPEND PALPABLE_MAY_USE_formats/scene vdb)
