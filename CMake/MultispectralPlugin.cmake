# The ParaView plugin: build/plugin/lib/Multispectral/Multispectral.so
# Optional components only: ParaView's package would otherwise ask for the development files of every library that
# ParaView uses, most of which a plugin never sees.
find_package(ParaView 5.11 REQUIRED QUIET OPTIONAL_COMPONENTS RemotingServerManager)
# What ParaView's libraries link is named in their targets, though it is theirs alone: names are enough.
foreach(library IN ITEMS MPI::MPI_C Freetype::Freetype GLEW::GLEW X11::X11)
  if(NOT TARGET ${library})
    add_library(${library} INTERFACE IMPORTED)
  endif()
endforeach()
set(known_versions 5.11)
if(NOT "${ParaView_VERSION_MAJOR}.${ParaView_VERSION_MINOR}" IN_LIST known_versions)
  message(WARNING "This is ParaView ${ParaView_VERSION}; known to work: ${known_versions}. Other versions were not tried.")
endif()
include(MultispectralModules)
list(APPEND MULTISPECTRAL_MODULES Multispectral::Domains Multispectral::Representations Multispectral::Scene)
list(APPEND MULTISPECTRAL_MODULE_FILES
  "${PROJECT_SOURCE_DIR}/Plugin/Domains/vtk.module"
  "${PROJECT_SOURCE_DIR}/Plugin/Representations/vtk.module"
  "${PROJECT_SOURCE_DIR}/Plugin/Scene/vtk.module")

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
  LIBRARY_SUBDIRECTORY "${PARAVIEW_PLUGIN_SUBDIR}"
  INSTALL_HEADERS OFF
  ADD_INSTALL_RPATHS OFF
  PLUGINS_COMPONENT Runtime
  PLUGINS_FILE_NAME "multispectral.plugins.xml")
# In the build tree the plugin has a short path, beside a list that makes ParaView load it.
set_target_properties(Multispectral PROPERTIES
  LIBRARY_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/lib/Multispectral")
file(WRITE "${CMAKE_BINARY_DIR}/lib/multispectral.plugins.xml"
  "<?xml version=\"1.0\"?>\n<Plugins>\n  <Plugin name=\"Multispectral\" auto_load=\"1\"/>\n</Plugins>\n")

multispectral_unity_modules()
include(MultispectralPython)
