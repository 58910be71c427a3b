# What `cmake --install` puts in place for those who build on maille: each room is a component with its library,
# headers, CMake targets and a .pc file.
include_guard()
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(MAILLE_INCLUDE_FOLDER ${CMAKE_INSTALL_INCLUDEDIR}/maille)
file(RELATIVE_PATH MAILLE_PREFIX_FROM_PC /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
set(MAILLE_PACKAGE_FOLDER ${CMAKE_INSTALL_LIBDIR}/cmake/maille)

# The modules that each room's .pc file asks for, and what has no module.
set(MAILLE_MODULES_volmesh "eigen3 fmt tbb pugixml libdeflate libisal nlohmann_json openmesh")
set(MAILLE_MODULES_quality "maille-volmesh")
set(MAILLE_MODULES_refine "maille-quality muparser")
set(MAILLE_MODULES_modeler "maille-quality polyclipping")
set(MAILLE_LIBRARIES_modeler "-lmpfr -lgmp")

function(maille_install_room name)
  install(TARGETS maille_${name} EXPORT maille-${name}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${name})
  install(EXPORT maille-${name} NAMESPACE maille:: DESTINATION ${MAILLE_PACKAGE_FOLDER} COMPONENT ${name})
  install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} DESTINATION ${MAILLE_INCLUDE_FOLDER} COMPONENT ${name}
    FILES_MATCHING PATTERN "*.hh")
  set(room ${name})
  set(modules "${MAILLE_MODULES_${name}}")
  set(libraries "${MAILLE_LIBRARIES_${name}}")
  configure_file(${PROJECT_SOURCE_DIR}/cmake/maille.pc.in ${PROJECT_BINARY_DIR}/maille-${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/maille-${name}.pc
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT ${name})
endfunction()

# maille-config.cmake, which any room needs: part of the component `volmesh`, as every room is built on it.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/maille-config-version.cmake COMPATIBILITY SameMinorVersion)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/maille-config.cmake.in
  ${PROJECT_BINARY_DIR}/maille-config.cmake INSTALL_DESTINATION ${MAILLE_PACKAGE_FOLDER})
install(FILES ${PROJECT_BINARY_DIR}/maille-config.cmake ${PROJECT_BINARY_DIR}/maille-config-version.cmake
  DESTINATION ${MAILLE_PACKAGE_FOLDER} COMPONENT volmesh)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/LICENSES/LGPL-3.0-or-later.txt
  ${PROJECT_SOURCE_DIR}/LICENSES/GPL-3.0-or-later.txt
  DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT volmesh)
