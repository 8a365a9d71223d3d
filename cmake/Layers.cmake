# The one table of who may use whom (docs/architecture.md explains it; tests/layers enforces it).
# palpable_module() refuses a link that is not in it; cmake/CheckLayers.cmake refuses such an #include.
set(PALPABLE_MODULES core models formats sources vision sculpt measure draw device haptics voice session page study cli)

set(PALPABLE_MAY_USE_core "")
set(PALPABLE_MAY_USE_models core)
set(PALPABLE_MAY_USE_formats core models)
set(PALPABLE_MAY_USE_sources core formats)
set(PALPABLE_MAY_USE_vision core)
set(PALPABLE_MAY_USE_sculpt core vision models)
set(PALPABLE_MAY_USE_measure core vision models)
set(PALPABLE_MAY_USE_draw core models measure)
set(PALPABLE_MAY_USE_device core)
set(PALPABLE_MAY_USE_haptics core models device)
set(PALPABLE_MAY_USE_voice core)
set(PALPABLE_MAY_USE_session core sources vision models sculpt formats measure draw device haptics voice)
set(PALPABLE_MAY_USE_page ${PALPABLE_MAY_USE_session} session)
set(PALPABLE_MAY_USE_study ${PALPABLE_MAY_USE_session} session)
set(PALPABLE_MAY_USE_cli ${PALPABLE_MAY_USE_session} session page study)

# Headers that a module's files must never include, as regular expressions: the servo's side stays small and free.
set(PALPABLE_FREE_OF_VISION core models haptics device)
set(PALPABLE_VISION_HEADERS "opencv2/|ceres/|tesseract/|libheif/|osmium/")
