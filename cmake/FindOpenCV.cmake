# OpenCV's parts one by one, as targets opencv_core, opencv_imgproc, … Debian keeps OpenCVConfig.cmake in the meta-package
# libopencv-dev, which pulls in a hundred packages that we do not use; the parts' own packages have headers and libraries.
find_path(OpenCV_INCLUDE_DIR opencv2/core.hpp PATH_SUFFIXES opencv4)
foreach(part ${OpenCV_FIND_COMPONENTS})
  find_library(OpenCV_${part}_LIBRARY opencv_${part})
  if(OpenCV_INCLUDE_DIR AND OpenCV_${part}_LIBRARY)
    set(OpenCV_${part}_FOUND TRUE)
    if(NOT TARGET opencv_${part})
      add_library(opencv_${part} UNKNOWN IMPORTED)
      set_target_properties(opencv_${part} PROPERTIES IMPORTED_LOCATION ${OpenCV_${part}_LIBRARY}
                                                      INTERFACE_INCLUDE_DIRECTORIES ${OpenCV_INCLUDE_DIR})
    endif()
  endif()
endforeach()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenCV REQUIRED_VARS OpenCV_INCLUDE_DIR HANDLE_COMPONENTS)
