# `./multispectral package`: the component Runtime as a Debian package.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME multispectral)
set(CPACK_PACKAGE_VERSION "${PROJECT_VERSION}")
set(CPACK_PACKAGE_CONTACT "Multispectral maintainers <multispectral@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "spectral reflectance from multispectral cameras, in ParaView")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "Estimates spectral reflectance from multispectral camera responses, corrects
cross-media instrument metamerism with a few measured samples, shows where the
result is wrong, and finds why a simulated and a real camera disagree.

This package holds the ParaView plugin, the command multispectral, which runs
without a display, and the data of its demonstration.")
# The plugin fits the ParaView that it was built with.
set(CPACK_DEBIAN_PACKAGE_DEPENDS
  "paraview (>= ${ParaView_VERSION}), paraview (<< ${ParaView_VERSION_MAJOR}.${ParaView_VERSION_MINOR}.99), python3 (>= 3.11), python3 (<< 3.12), python3-paraview, python3-matplotlib, python3-pyqt5, libqt5svg5, openmpi-bin")

set(packaging "${PROJECT_SOURCE_DIR}/Packaging")
# ParaView, pvpython, pvbatch and pvserver load the plugins of the folder `plugins` beside them at their start.
install(CODE "
  file(MAKE_DIRECTORY \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/bin\")
  file(CREATE_LINK \"../${CMAKE_INSTALL_LIBDIR}/${PARAVIEW_PLUGIN_SUBDIR}/Multispectral\"
    \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/bin/plugins\" SYMBOLIC)"
  COMPONENT Package EXCLUDE_FROM_ALL)
set(CPACK_COMPONENTS_ALL Runtime Package)

# Debian's own texts, for the package alone.
set(documents "${CMAKE_INSTALL_DATADIR}/doc/multispectral")
install(FILES "${packaging}/copyright" DESTINATION "${documents}" COMPONENT Package EXCLUDE_FROM_ALL)
install(FILES "${packaging}/lintian-overrides" DESTINATION "${CMAKE_INSTALL_DATADIR}/lintian/overrides"
  RENAME multispectral COMPONENT Package EXCLUDE_FROM_ALL)
find_program(GZIP_PROGRAM gzip REQUIRED)
file(MAKE_DIRECTORY "${PROJECT_BINARY_DIR}/Packaging")
execute_process(COMMAND "${GZIP_PROGRAM}" -9nc "${packaging}/changelog"
  OUTPUT_FILE "${PROJECT_BINARY_DIR}/Packaging/changelog.gz" COMMAND_ERROR_IS_FATAL ANY)
install(FILES "${PROJECT_BINARY_DIR}/Packaging/changelog.gz" DESTINATION "${documents}" COMPONENT Package EXCLUDE_FROM_ALL)
include(CPack)
