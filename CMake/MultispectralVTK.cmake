# The filters and readers as ordinary VTK modules, without ParaView.
find_package(VTK 9.1 REQUIRED)
include(MultispectralModules)

vtk_module_scan(
  MODULE_FILES ${MULTISPECTRAL_MODULE_FILES}
  REQUEST_MODULES ${MULTISPECTRAL_MODULES}
  PROVIDES_MODULES enabled_modules)
vtk_module_build(
  MODULES ${enabled_modules}
  ENABLE_WRAPPING OFF
  INSTALL_HEADERS OFF)
