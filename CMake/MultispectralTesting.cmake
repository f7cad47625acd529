# multispectral_add_unit_tests(NAME <room> SOURCES <file>... [LINK <target>...] [SANITIZED <filter>]
#   [ENVIRONMENT <name=value>...])
#
# One GoogleTest program for the tests of one room; each of its suites becomes a CTest test named <face>.<room>.<Suite>,
# so that the same suite run against several builds stays apart.
# SANITIZED: the tests (a GoogleTest filter) that run under the sanitizers, where all would take many minutes.
if(BUILD_TESTING)
  enable_testing()
  find_package(GTest REQUIRED)
endif()

if(MULTISPECTRAL_SANITIZE)
  set(MULTISPECTRAL_TEST_PREFIX "sanitize.")
else()
  set(MULTISPECTRAL_TEST_PREFIX "${MULTISPECTRAL_FACE}.")
endif()

function(multispectral_add_unit_tests)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "NAME;SANITIZED" "SOURCES;LINK;ENVIRONMENT")
  if(NOT BUILD_TESTING)
    return()
  endif()
  set(target "Test${arg_NAME}")
  add_executable(${target} ${arg_SOURCES})
  target_link_libraries(${target} PRIVATE ${arg_LINK} MultispectralOptions GTest::gtest GTest::gtest_main)
  target_compile_definitions(${target} PRIVATE
    MULTISPECTRAL_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  # GCC 12 sees the memory of Eigen's vectors used after it was freed where it is not.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-use-after-free>)
  multispectral_unity(${target})
  set(filter "*")
  if(MULTISPECTRAL_SANITIZE AND arg_SANITIZED)
    set(filter "${arg_SANITIZED}")
  endif()
  set(suites "${CMAKE_CURRENT_BINARY_DIR}/${target}.cmake")
  file(GENERATE OUTPUT "${suites}" CONTENT "set(program \"$<TARGET_FILE:${target}>\")
set(prefix \"${MULTISPECTRAL_TEST_PREFIX}${arg_NAME}.\")
set(label \"${arg_NAME}\")
set(filter \"${filter}\")
set(environment \"${arg_ENVIRONMENT}\")
include(\"${PROJECT_SOURCE_DIR}/CMake/MultispectralSuites.cmake\")
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES "${suites}")
endfunction()

# multispectral_add_module_tests(MODULE <name> SOURCES <file>... [LINK <target>...])
#
# The unit tests of one vtk module, called from the module's Testing/ folder, which vtk_module_build
# adds in both faces that have modules.
function(multispectral_add_module_tests)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "MODULE" "SOURCES;LINK")
  if(NOT BUILD_TESTING)
    return()
  endif()
  multispectral_add_unit_tests(NAME ${arg_MODULE}
    SOURCES ${arg_SOURCES}
    LINK Multispectral::${arg_MODULE} Multispectral::DataModel Multispectral::Kernels
      VTK::CommonCore VTK::CommonDataModel VTK::CommonExecutionModel ${arg_LINK})
  target_include_directories(Test${arg_MODULE} PRIVATE "${PROJECT_SOURCE_DIR}/Testing")
  # Beside the other test programs, not in the plugin's own folder.
  set_target_properties(Test${arg_MODULE} PROPERTIES
    RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")
endfunction()
