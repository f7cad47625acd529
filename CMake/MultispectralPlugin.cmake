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

# The generated wrappers of a module's classes for the server manager belong together too.
foreach(module IN LISTS MULTISPECTRAL_MODULES)
  string(REPLACE "::" "" library "${module}")
  string(REPLACE "Multispectral::" "" target "${module}")
  multispectral_unity(${target})
  if(MULTISPECTRAL_UNITY AND TARGET ${library}CS)
    set_target_properties(${library}CS PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 12)
  endif()
endforeach()
