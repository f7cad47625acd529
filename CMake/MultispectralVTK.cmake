# The filters and readers as ordinary VTK modules, without ParaView.
# Optional components: only what the libraries in use link is asked for.
find_package(VTK 9.1 REQUIRED QUIET OPTIONAL_COMPONENTS
  CommonCore CommonDataModel CommonExecutionModel IOCore ParallelCore
  ChartsCore InteractionStyle IOImage RenderingAnnotation RenderingContextOpenGL2 RenderingFreeType RenderingImage
  RenderingOpenGL2 ViewsContext2D
  Python PythonInterpreter WrappingPythonCore WrappingTools)
include(MultispectralModules)

vtk_module_scan(
  MODULE_FILES ${MULTISPECTRAL_MODULE_FILES}
  REQUEST_MODULES ${MULTISPECTRAL_MODULES}
  PROVIDES_MODULES enabled_modules)
set(wrapping OFF)
if(TARGET VTK::WrapPython AND TARGET VTK::WrapHierarchy)
  set(wrapping ON)
endif()
# The unit tests of the modules run against ParaView's VTK.
vtk_module_build(
  MODULES ${enabled_modules}
  PACKAGE Multispectral
  INSTALL_EXPORT MultispectralModules
  INSTALL_HEADERS ON
  HEADERS_DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/multispectral"
  CMAKE_DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/Multispectral"
  HEADERS_COMPONENT Development
  TARGETS_COMPONENT Development
  TEST_DIRECTORY_NAME NONE
  ENABLE_WRAPPING ${wrapping})
multispectral_unity_modules()
include(MultispectralPython)
