# The filters and readers as ordinary VTK modules, without ParaView.
# Optional components: only what the libraries in use link is asked for.
find_package(VTK 9.1 REQUIRED QUIET OPTIONAL_COMPONENTS
  CommonCore CommonDataModel CommonExecutionModel IOCore ParallelCore
  ChartsCore InteractionStyle IOImage RenderingAnnotation RenderingContextOpenGL2 RenderingFreeType RenderingImage
  RenderingOpenGL2 ViewsContext2D)
include(MultispectralModules)

vtk_module_scan(
  MODULE_FILES ${MULTISPECTRAL_MODULE_FILES}
  REQUEST_MODULES ${MULTISPECTRAL_MODULES}
  PROVIDES_MODULES enabled_modules)
vtk_module_build(
  MODULES ${enabled_modules}
  ENABLE_WRAPPING OFF
  INSTALL_HEADERS OFF)
