# `cmake --install`: installs the modules for use by other programs, as static libraries with their headers, a CMake package
# and pkg-config files. Each module is an install component, so that the modules of the servo can be installed alone:
#   for c in core models device haptics; do cmake --install build --component $c; done
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(PALPABLE_COMPONENTS core models formats sources vision hearing sculpt recipes measure device haptics describe session)
set(palpable_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Palpable)
set(palpable_tables "")

# palpable_install(NAME, used modules, links): called by palpable_module().
function(palpable_install name uses links)
  set_target_properties(palpable_${name} PROPERTIES EXPORT_NAME ${name})
  install(TARGETS palpable_${name} EXPORT PalpableTargets-${name}
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${name})
  install(EXPORT PalpableTargets-${name} NAMESPACE Palpable:: DESTINATION ${palpable_package_dir} COMPONENT ${name})
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/palpable/${name} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/palpable
          COMPONENT ${name} FILES_MATCHING PATTERN "*.hpp" PATTERN "test_*.hpp" EXCLUDE 
          PATTERN "stroke_scenes.hpp" EXCLUDE PATTERN "crossing_strokes.hpp" EXCLUDE PATTERN "sheet_scene*.hpp" EXCLUDE PATTERN "house_scenes.hpp" EXCLUDE)
  set(requires ${uses})
  list(TRANSFORM requires PREPEND "palpable-")
  set(private "")
  set(libs "-lpthread")
  foreach(link ${links})
    string(REPLACE "::" "_" key ${link})
    if(link MATCHES "^opencv_")
      list(APPEND libs "-l${link}")
    elseif(DEFINED palpable_pc_${key})
      list(APPEND private ${palpable_pc_${key}})
    elseif(DEFINED palpable_libs_${key})
      list(APPEND libs ${palpable_libs_${key}})
    endif()
  endforeach()
  # Not private: a program that links our static libraries must also link their dependencies.
  list(APPEND requires ${private})
  list(JOIN requires ", " palpable_requires)
  list(JOIN libs " " palpable_libs)
  set(palpable_name ${name})
  file(RELATIVE_PATH palpable_up /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/palpable.pc.in ${CMAKE_BINARY_DIR}/package/palpable-${name}.pc @ONLY)
  install(FILES ${CMAKE_BINARY_DIR}/package/palpable-${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT ${name})
  set_property(GLOBAL APPEND_STRING PROPERTY palpable_tables
               "set(palpable_uses_${name} ${uses})\nset(palpable_links_${name} ${links})\n")
endfunction()

# After all modules.
function(palpable_install_package)
  get_property(tables GLOBAL PROPERTY palpable_tables)
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/package/PalpableComponents.cmake
       CONTENT "# The modules and the external libraries that each module uses.\n${tables}" @ONLY)
  configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/PalpableConfig.cmake.in ${CMAKE_BINARY_DIR}/package/PalpableConfig.cmake
                                INSTALL_DESTINATION ${palpable_package_dir})
  write_basic_package_version_file(${CMAKE_BINARY_DIR}/package/PalpableConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${CMAKE_BINARY_DIR}/package/PalpableConfig.cmake ${CMAKE_BINARY_DIR}/package/PalpableConfigVersion.cmake
                ${CMAKE_BINARY_DIR}/package/PalpableComponents.cmake ${PROJECT_SOURCE_DIR}/cmake/PalpableDependencies.cmake
                ${PROJECT_SOURCE_DIR}/cmake/FindOpenCV.cmake
          DESTINATION ${palpable_package_dir} COMPONENT core)
  install(FILES ${PROJECT_SOURCE_DIR}/src/palpable/palpable.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/palpable COMPONENT core)
endfunction()
