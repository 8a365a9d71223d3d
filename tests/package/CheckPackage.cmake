# Installs components of a build into an empty folder, and builds and runs the examples against it as a project of their own.
# Run: cmake -DBUILD=<build> -DEXAMPLES=<examples> -DWORK=<empty folder> -DCOMPONENTS=core,models,… -DWITH_VISION=OFF
#            -DCOMPILER=<c++> [-DSAMPLES=<folder of the sample pair>] -P CheckPackage.cmake
# Without vision no vision library may be looked for: the project is configured with every outside package disabled.
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${WORK})
string(REPLACE "," ";" components "${COMPONENTS}")
foreach(component ${components})
  execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --component ${component} --prefix ${WORK}/prefix
                  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
endforeach()
set(disabled "")
if(NOT WITH_VISION)
  foreach(package OpenCV Eigen3 Ceres fmt nlohmann_json PkgConfig Boost PNG JPEG TIFF OpenEXR assimp ZLIB TBB)
    list(APPEND disabled -DCMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
  endforeach()
endif()
execute_process(COMMAND ${CMAKE_COMMAND} -G Ninja -S ${EXAMPLES} -B ${WORK}/build -DCMAKE_PREFIX_PATH=${WORK}/prefix
                        -DCMAKE_CXX_COMPILER=${COMPILER} -DWITH_VISION=${WITH_VISION} ${disabled}
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${WORK}/build COMMAND_ERROR_IS_FATAL ANY)
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
