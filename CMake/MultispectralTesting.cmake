# multispectral_add_unit_tests(NAME <room> SOURCES <file>... [LINK <target>...] [SANITIZED <filter>])
#
# One GoogleTest program for the tests of one room; each TEST becomes a CTest test named
# <face>.<room>.<Suite>.<Test>, so that the same test run against several builds stays apart.
# UNITY: compiled in groups; names in anonymous namespaces must differ within a folder.
# SANITIZED: the tests (a GoogleTest filter) that run under the sanitizers, where all would take many minutes.
if(BUILD_TESTING)
  enable_testing()
  find_package(GTest REQUIRED)
  include(GoogleTest)
endif()

if(MULTISPECTRAL_SANITIZE)
  set(MULTISPECTRAL_TEST_PREFIX "sanitize.")
else()
  set(MULTISPECTRAL_TEST_PREFIX "${MULTISPECTRAL_FACE}.")
endif()

function(multispectral_add_unit_tests)
  cmake_parse_arguments(PARSE_ARGV 0 arg "UNITY" "NAME;SANITIZED" "SOURCES;LINK")
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
  if(arg_UNITY)
    multispectral_unity(${target})
  endif()
  set(filter)
  if(MULTISPECTRAL_SANITIZE AND arg_SANITIZED)
    set(filter TEST_FILTER "${arg_SANITIZED}")
  endif()
  gtest_discover_tests(${target} ${filter}
    TEST_PREFIX "${MULTISPECTRAL_TEST_PREFIX}${arg_NAME}."
    DISCOVERY_MODE PRE_TEST
    PROPERTIES LABELS "${arg_NAME}" TIMEOUT 300)
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
