# The table of allowed dependencies between modules, and between the rooms (folders) of large modules. docs/architecture.md
# explains it. palpable_module() refuses a link that is not in the table; the test tests/layers runs cmake/CheckLayers.cmake,
# which refuses an #include that is not in the table, and a permission that no file uses.
set(PALPABLE_MODULES core models formats sources vision sculpt recipes measure draw device haptics voice describe session page onefile study cli)

set(PALPABLE_MAY_USE_core "")
set(PALPABLE_MAY_USE_models core)
set(PALPABLE_MAY_USE_formats core models)
set(PALPABLE_MAY_USE_sources core formats)
set(PALPABLE_MAY_USE_vision core)
set(PALPABLE_MAY_USE_sculpt core models vision)
set(PALPABLE_MAY_USE_recipes core models vision sculpt)
set(PALPABLE_MAY_USE_measure core vision sculpt)
set(PALPABLE_MAY_USE_draw core models)
set(PALPABLE_MAY_USE_device core)
set(PALPABLE_MAY_USE_haptics core models device)
set(PALPABLE_MAY_USE_voice core)
set(PALPABLE_MAY_USE_describe core models)
set(PALPABLE_MAY_USE_session core models formats sources vision sculpt recipes measure device haptics describe)
set(PALPABLE_MAY_USE_page core models formats device haptics describe session)
set(PALPABLE_MAY_USE_onefile core models formats device haptics describe session page)
set(PALPABLE_MAY_USE_study core models vision sculpt device haptics)
set(PALPABLE_MAY_USE_cli core models formats sources vision sculpt recipes measure draw device haptics voice describe session page onefile study)

# Rooms, bottom-up. Files directly in a module's folder are its interface: every room may use them, and they use no room.
# Tests in a room may use every room of their module.
set(PALPABLE_ROOMS_core picture geometry numbers text system files)
set(PALPABLE_MAY_USE_core/files system)

set(PALPABLE_ROOMS_models relief material field grid contours streets scene)
set(PALPABLE_MAY_USE_models/material relief)
set(PALPABLE_MAY_USE_models/field relief)
set(PALPABLE_MAY_USE_models/grid relief)
set(PALPABLE_MAY_USE_models/contours relief)
set(PALPABLE_MAY_USE_models/scene relief material field grid contours)

set(PALPABLE_ROOMS_formats packing picture mesh tactile vdb scene)
set(PALPABLE_MAY_USE_formats/mesh picture)
set(PALPABLE_MAY_USE_formats/scene packing picture)

set(PALPABLE_ROOMS_sources isolated picture stereo solid calibration depth video map input live decoder)
set(PALPABLE_MAY_USE_sources/picture isolated)
set(PALPABLE_MAY_USE_sources/solid isolated)
set(PALPABLE_MAY_USE_sources/calibration isolated)
set(PALPABLE_MAY_USE_sources/stereo picture)
set(PALPABLE_MAY_USE_sources/depth picture calibration)
set(PALPABLE_MAY_USE_sources/video isolated picture)
set(PALPABLE_MAY_USE_sources/map isolated)
set(PALPABLE_MAY_USE_sources/input picture stereo solid depth)
set(PALPABLE_MAY_USE_sources/live picture depth)
set(PALPABLE_MAY_USE_sources/decoder isolated picture solid calibration video map)

set(PALPABLE_ROOMS_vision image depth_camera mapping segmentation stereo/problem stereo/cost stereo/range stereo/occlusion stereo/planes stereo/methods rectification stereo/result contours motion/tracks motion/structure motion/depth text streets)
set(PALPABLE_MAY_USE_vision/mapping depth_camera)
set(PALPABLE_MAY_USE_vision/stereo/cost image stereo/problem)
set(PALPABLE_MAY_USE_vision/stereo/range image stereo/cost)
set(PALPABLE_MAY_USE_vision/stereo/occlusion image)
set(PALPABLE_MAY_USE_vision/stereo/planes image segmentation stereo/cost stereo/occlusion)
set(PALPABLE_MAY_USE_vision/stereo/methods image segmentation stereo/problem stereo/cost stereo/range stereo/occlusion stereo/planes)
set(PALPABLE_MAY_USE_vision/stereo/result image rectification stereo/problem stereo/range stereo/occlusion stereo/methods)
set(PALPABLE_MAY_USE_vision/rectification image stereo/problem stereo/methods)
set(PALPABLE_MAY_USE_vision/contours image)
set(PALPABLE_MAY_USE_vision/motion/tracks image)
set(PALPABLE_MAY_USE_vision/motion/structure motion/tracks)
set(PALPABLE_MAY_USE_vision/motion/depth image stereo/cost motion/tracks motion/structure)
set(PALPABLE_MAY_USE_vision/streets text)

set(PALPABLE_ROOMS_sculpt relief contours triangles solid field correction points superquadric streets)
set(PALPABLE_MAY_USE_sculpt/solid triangles)
set(PALPABLE_MAY_USE_sculpt/field triangles solid)
set(PALPABLE_MAY_USE_sculpt/correction triangles solid field)
set(PALPABLE_MAY_USE_sculpt/points relief triangles)
set(PALPABLE_MAY_USE_sculpt/superquadric triangles points)

set(PALPABLE_ROOMS_recipes relief solid video)
set(PALPABLE_MAY_USE_recipes/solid relief)
set(PALPABLE_MAY_USE_recipes/video solid)

set(PALPABLE_ROOMS_draw canvas view)
set(PALPABLE_MAY_USE_draw/view canvas)

set(PALPABLE_ROOMS_device transport simulated pointer recording two_diy falcon force_dimension open_haptics inverse3 evdev remote virtual drivers)
set(PALPABLE_MAY_USE_device/two_diy transport)
set(PALPABLE_MAY_USE_device/falcon transport)
set(PALPABLE_MAY_USE_device/force_dimension transport)
set(PALPABLE_MAY_USE_device/evdev transport)
set(PALPABLE_MAY_USE_device/open_haptics transport)
set(PALPABLE_MAY_USE_device/inverse3 transport)
set(PALPABLE_MAY_USE_device/remote transport recording)
set(PALPABLE_MAY_USE_device/virtual transport two_diy falcon evdev)
set(PALPABLE_MAY_USE_device/drivers simulated pointer recording two_diy falcon force_dimension open_haptics inverse3 evdev remote)

set(PALPABLE_ROOMS_haptics safety effect proxy law tick servo guardian)
set(PALPABLE_MAY_USE_haptics/proxy effect)
set(PALPABLE_MAY_USE_haptics/law effect proxy)
set(PALPABLE_MAY_USE_haptics/tick safety effect law)
set(PALPABLE_MAY_USE_haptics/servo safety effect law tick)

set(PALPABLE_ROOMS_session make touch share check)
set(PALPABLE_MAY_USE_describe core models)
set(PALPABLE_MAY_USE_session/touch make)
set(PALPABLE_MAY_USE_session/share touch)
set(PALPABLE_MAY_USE_session/check touch)

set(PALPABLE_ROOMS_page shelf)

set(PALPABLE_ROOMS_onefile wasm)

set(PALPABLE_ROOMS_study simulated world)

set(PALPABLE_ROOMS_cli arguments keys video commands/score commands/touch commands/export commands)
set(PALPABLE_MAY_USE_cli/commands/score arguments)
set(PALPABLE_MAY_USE_cli/commands/touch arguments keys)
set(PALPABLE_MAY_USE_cli/commands/export arguments)
set(PALPABLE_MAY_USE_cli/commands arguments video)

# Regular expressions of headers that a module must never include: the modules of the servo need no vision library.
set(PALPABLE_FREE_OF_VISION core models haptics device)
set(PALPABLE_VISION_HEADERS "opencv2/|ceres/|tesseract/|libheif/|osmium/")
