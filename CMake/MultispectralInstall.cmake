# What `cmake --install` puts where, and the Debian package.
#   Runtime      the plugin, the command `multispectral`, its programs, the demo's data, the pages
#   Development  headers and libraries of kernels, formats and VTK modules, for find_package(Multispectral)
include(CMakePackageConfigHelpers)
set(package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/Multispectral")

install(TARGETS MultispectralKernels MultispectralOptions EXPORT MultispectralTargets
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT Development)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/Filters/Kernels" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/multispectral"
  COMPONENT Development FILES_MATCHING PATTERN "*.h" PATTERN "*Test*" EXCLUDE PATTERN "*-inl.h" EXCLUDE)
if(TARGET MultispectralFormats)
  install(TARGETS MultispectralFormats EXPORT MultispectralTargets
    ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT Development)
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/Readers/Formats" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/multispectral"
    COMPONENT Development FILES_MATCHING PATTERN "*.h" PATTERN "*Test*" EXCLUDE)
endif()
install(EXPORT MultispectralTargets NAMESPACE Multispectral:: DESTINATION "${package_folder}" COMPONENT Development)
set(MULTISPECTRAL_FORMATS_DEPENDENCIES)
if(TARGET MultispectralFormats)
  set(MULTISPECTRAL_FORMATS_DEPENDENCIES "find_dependency(PkgConfig)
pkg_check_modules(OpenImageIO REQUIRED IMPORTED_TARGET OpenImageIO)
pkg_search_module(Hdf5Serial REQUIRED IMPORTED_TARGET hdf5-serial hdf5)
find_dependency(ZLIB)
find_dependency(pugixml)
find_dependency(nlohmann_json 3.11)")
endif()
set(MULTISPECTRAL_MODULES_BUILT OFF)
if(MULTISPECTRAL_FACE STREQUAL "vtk")
  set(MULTISPECTRAL_MODULES_BUILT ON)
  # The modules' own description of the build tree names these.
  export(EXPORT MultispectralTargets NAMESPACE Multispectral::
    FILE "${PROJECT_BINARY_DIR}/${package_folder}/MultispectralTargets.cmake")
endif()
configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/MultispectralConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/MultispectralConfig.cmake" INSTALL_DESTINATION "${package_folder}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/MultispectralConfigVersion.cmake"
  COMPATIBILITY SameMajorVersion)
install(FILES "${PROJECT_BINARY_DIR}/MultispectralConfig.cmake" "${PROJECT_BINARY_DIR}/MultispectralConfigVersion.cmake"
  DESTINATION "${package_folder}" COMPONENT Development)

if(NOT MULTISPECTRAL_FACE STREQUAL "plugin")
  return()
endif()

# The programs and their data stand as in the clone, below one folder; the launcher finds that folder through its link.
set(home "${CMAKE_INSTALL_DATADIR}/multispectral")
install(PROGRAMS "${PROJECT_SOURCE_DIR}/multispectral" DESTINATION "${home}" COMPONENT Runtime)
install(DIRECTORY Plugin/Scripts Plugin/Proxies Plugin/Desktop DESTINATION "${home}/Plugin" COMPONENT Runtime
  USE_SOURCE_PERMISSIONS PATTERN "__pycache__" EXCLUDE)
install(DIRECTORY Data DESTINATION "${home}" COMPONENT Runtime)
install(DIRECTORY Documentation/ DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/multispectral" COMPONENT Runtime)
install(FILES README.md CHANGELOG.md CITATION.cff DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/multispectral" COMPONENT Runtime)
file(RELATIVE_PATH plugin "/prefix/${home}"
  "/prefix/${CMAKE_INSTALL_LIBDIR}/${PARAVIEW_PLUGIN_SUBDIR}/Multispectral/Multispectral.so")
file(RELATIVE_PATH python "/prefix/${home}" "/prefix/${MULTISPECTRAL_PYTHON_DESTINATION}")
file(WRITE "${PROJECT_BINARY_DIR}/installed" "${plugin}\n${python}\n")
install(FILES "${PROJECT_BINARY_DIR}/installed" DESTINATION "${home}" COMPONENT Runtime)
file(RELATIVE_PATH launcher "/prefix/${CMAKE_INSTALL_BINDIR}" "/prefix/${home}/multispectral")
install(CODE "
  file(MAKE_DIRECTORY \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_BINDIR}\")
  file(CREATE_LINK \"${launcher}\" \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_BINDIR}/multispectral\" SYMBOLIC)"
  COMPONENT Runtime)
include(MultispectralPackage)
