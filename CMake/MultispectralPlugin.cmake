# The ParaView plugin: build/plugin/lib/Multispectral/Multispectral.so
find_package(ParaView 5.11 REQUIRED)
include(MultispectralModules)
list(APPEND MULTISPECTRAL_MODULES Multispectral::Representations)
list(APPEND MULTISPECTRAL_MODULE_FILES "${PROJECT_SOURCE_DIR}/Plugin/Representations/vtk.module")

# The plugin itself is one loadable library; its modules are static inside it.
set(BUILD_SHARED_LIBS ON)

set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/lib")
set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/lib")

paraview_plugin_scan(
  PLUGIN_FILES "${PROJECT_SOURCE_DIR}/Plugin/paraview.plugin"
  PROVIDES_PLUGINS plugins
  ENABLE_BY_DEFAULT ON)
paraview_plugin_build(
  PLUGINS ${plugins}
  PLUGINS_FILE_NAME "multispectral.plugins.xml")
