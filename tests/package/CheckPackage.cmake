# Installs components of a build into an empty folder; then builds and runs the examples as a separate project that uses it.
# Run: cmake -DBUILD=<build> -DEXAMPLES=<examples> -DWORK=<empty folder> -DCOMPONENTS=core,models,… -DWITH_VISION=OFF
#            -DCOMPILER=<c++> [-DSAMPLES=<folder of the sample pair>] -P CheckPackage.cmake
# Without vision, the project must not search for a vision library: it is configured with all external packages disabled.
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${WORK})
string(REPLACE "," ";" components "${COMPONENTS}")
foreach(component ${components})
  execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --component ${component} --prefix ${WORK}/prefix
                  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
endforeach()
set(disabled "")
if(NOT WITH_VISION)
  foreach(package OpenCV Eigen3 Ceres fmt nlohmann_json PkgConfig Boost PNG JPEG TIFF OpenEXR assimp TBB)
    list(APPEND disabled -DCMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
  endforeach()
endif()
execute_process(COMMAND ${CMAKE_COMMAND} -G Ninja -S ${EXAMPLES} -B ${WORK}/build -DCMAKE_PREFIX_PATH=${WORK}/prefix
                        -DCMAKE_CXX_COMPILER=${COMPILER} -DWITH_VISION=${WITH_VISION} ${disabled}
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${WORK}/build COMMAND_ERROR_IS_FATAL ANY)
# The same with only pkg-config and the compiler.
file(GLOB_RECURSE pc ${WORK}/prefix/palpable-core.pc)
get_filename_component(pc_folder "${pc}" DIRECTORY)
if(WITH_VISION)
  set(by_pkg_config stereo_to_stl)
  set(packages palpable-recipes palpable-formats palpable-sources)
else()
  set(by_pkg_config touch_height_field custom_device custom_law)
  set(packages palpable-haptics)
endif()
execute_process(COMMAND ${CMAKE_COMMAND} -E env PKG_CONFIG_PATH=${pc_folder} pkg-config --cflags --libs ${packages}
                OUTPUT_VARIABLE flags OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
separate_arguments(flags UNIX_COMMAND "${flags}")
foreach(example ${by_pkg_config})
  execute_process(COMMAND ${COMPILER} ${EXAMPLES}/${example}.cpp ${flags} -o ${WORK}/${example}_by_pkg_config COMMAND_ERROR_IS_FATAL ANY)
endforeach()
if(NOT WITH_VISION)
  execute_process(COMMAND ${WORK}/touch_height_field_by_pkg_config COMMAND_ERROR_IS_FATAL ANY)
endif()
if(WITH_VISION)
  execute_process(COMMAND ${WORK}/build/stereo_to_stl ${SAMPLES}/sculpture_left.png ${SAMPLES}/sculpture_right.png ${WORK}/out.stl
                  COMMAND_ERROR_IS_FATAL ANY)
  file(SIZE ${WORK}/out.stl size)
  if(size LESS 100000)
    message(FATAL_ERROR "the STL file has only ${size} bytes")
  endif()
else()
  foreach(example touch_height_field custom_device custom_law)
    execute_process(COMMAND ${WORK}/build/${example} COMMAND_ERROR_IS_FATAL ANY)
  endforeach()
endif()
