# Wrong on purpose: the project's table with two permissions that nobody uses.
include(${CMAKE_CURRENT_LIST_DIR}/../../cmake/Layers.cmake)
list(APPEND PALPABLE_MAY_USE_voice models)
list(APPEND PALPABLE_MAY_USE_formats/scene vdb)
