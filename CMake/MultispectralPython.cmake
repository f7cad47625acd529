# The filters and readers for a plain Python beside vtkmodules, without ParaView: the package `multispectral`.
#
#   build/<preset>/python/multispectral/__init__.py
#   build/<preset>/python/multispectral/_classes.so   all modules in one extension, so that a process has them once
#
# VTK's own function makes an extension of each module; with static modules each would bring its own kernels. The
# sources of all modules are therefore generated with VTK's tools and linked together.
option(MULTISPECTRAL_PYTHON "Wrap the filters and readers for Python" ON)
# Where Debian's Python looks, below /usr.
set(MULTISPECTRAL_PYTHON_DESTINATION "lib/python3/dist-packages")

# multispectral_wrap_python(<module>..)
function(multispectral_wrap_python)
  set(name _classes)
  foreach(module IN LISTS ARGN)
    _vtk_module_real_target(_vtk_python_target_name "${module}")
    _vtk_module_get_module_property("${module}" PROPERTY library_name VARIABLE _vtk_python_library_name)
    _vtk_module_wrap_python_sources("${module}" module_sources module_classes)
    list(APPEND sources ${module_sources})
    list(APPEND classes ${module_classes})
    _vtk_module_get_module_property("${module}" PROPERTY depends VARIABLE public_depends)
    _vtk_module_get_module_property("${module}" PROPERTY private_depends VARIABLE private_depends)
    foreach(depend IN LISTS public_depends private_depends)
      if(NOT depend IN_LIST ARGN)
        _vtk_module_get_module_property("${depend}" PROPERTY python_package VARIABLE package)
        _vtk_module_get_module_property("${depend}" PROPERTY library_name VARIABLE library)
        if(package)
          list(APPEND depends "${package}.${library}")
        endif()
      endif()
    endforeach()
  endforeach()
  list(REMOVE_DUPLICATES depends)

  set(folder "${CMAKE_CURRENT_BINARY_DIR}/CMakeFiles/${name}Python")
  set(data "${folder}/${name}-init.data")
  file(GENERATE OUTPUT "${data}"
    CONTENT "${name}\n$<JOIN:${classes},\n>\nDEPENDS\n$<JOIN:${depends},\n>\n")
  set(init "${folder}/${name}Init.cxx" "${folder}/${name}InitImpl.cxx")
  add_custom_command(
    OUTPUT ${init}
    COMMAND VTK::WrapPythonInit "${data}" ${init}
    COMMENT "Generating the start of the Python package"
    DEPENDS "${data}")

  add_library(${name} MODULE ${sources} ${init})
  target_link_libraries(${name} PRIVATE ${ARGN} VTK::WrappingPythonCore VTK::Python)
  target_link_options(${name} PRIVATE "LINKER:--as-needed")
  target_compile_definitions(${name} PRIVATE "PYTHON_PACKAGE=\"multispectral\"")
  set_target_properties(${name} PROPERTIES
    PREFIX ""
    LIBRARY_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/python/multispectral")
  if(MULTISPECTRAL_UNITY)
    set_target_properties(${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 12)
    set_source_files_properties(${init} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  endif()
  configure_file("${PROJECT_SOURCE_DIR}/CMake/multispectral-package.py.in"
    "${CMAKE_BINARY_DIR}/python/multispectral/__init__.py" @ONLY)
  install(TARGETS ${name} LIBRARY DESTINATION "${MULTISPECTRAL_PYTHON_DESTINATION}/multispectral" COMPONENT Runtime)
  install(FILES "${CMAKE_BINARY_DIR}/python/multispectral/__init__.py"
    DESTINATION "${MULTISPECTRAL_PYTHON_DESTINATION}/multispectral" COMPONENT Runtime)
endfunction()

if(MULTISPECTRAL_PYTHON)
  # What VTK's own targets link.
  find_package(Python3 QUIET COMPONENTS Interpreter Development.Module Development.Embed)
  if(TARGET VTK::WrapPython AND TARGET VTK::WrappingPythonCore AND TARGET Python3::Python)
    set(modules ${MULTISPECTRAL_MODULES})
    list(REMOVE_ITEM modules Multispectral::Domains Multispectral::Representations)
    multispectral_wrap_python(${modules})
    if(TARGET Multispectral)
      add_dependencies(Multispectral _classes)  # the programs of the launcher run with it
    endif()
  else()
    message(STATUS "VTK's Python wrapping or python3-dev was not found: the package `multispectral` is left out")
  endif()
endif()
