# multispectral_unity(<target>)
#
# Compiles the sources of a target in groups: those of one folder together, at most MULTISPECTRAL_UNITY_SIZE of them.
# Eigen's templates are instantiated once a group instead of once a file, which halves the work of a build from nothing.
# Files that Highway compiles once for each instruction set stay alone. Names in anonymous namespaces must therefore
# differ within a folder.
option(MULTISPECTRAL_UNITY "Compile sources in groups: less work from nothing, more after a change" OFF)
set(MULTISPECTRAL_UNITY_SIZE 12 CACHE STRING "Largest number of sources compiled together")
mark_as_advanced(MULTISPECTRAL_UNITY_SIZE)

function(multispectral_unity target)
  if(NOT MULTISPECTRAL_UNITY)
    return()
  endif()
  get_target_property(directory ${target} SOURCE_DIR)
  get_target_property(sources ${target} SOURCES)
  set(folders)
  foreach(source IN LISTS sources)
    get_filename_component(source "${source}" ABSOLUTE BASE_DIR "${directory}")
    if(NOT source MATCHES "\\.(cpp|cxx)$" OR NOT EXISTS "${source}")
      continue()
    endif()
    file(STRINGS "${source}" highway REGEX "foreach_target" LIMIT_COUNT 1)
    if(highway)
      continue()
    endif()
    get_filename_component(folder "${source}" DIRECTORY)
    string(MD5 key "${folder}")
    list(APPEND folders ${key})
    list(APPEND sources_${key} "${source}")
  endforeach()
  list(REMOVE_DUPLICATES folders)
  foreach(key IN LISTS folders)
    # Groups of about equal size.
    list(LENGTH sources_${key} count)
    math(EXPR groups "(${count} + ${MULTISPECTRAL_UNITY_SIZE} - 1) / ${MULTISPECTRAL_UNITY_SIZE}")
    set(index 0)
    foreach(source IN LISTS sources_${key})
      math(EXPR group "${index} * ${groups} / ${count}")
      set_source_files_properties("${source}" TARGET_DIRECTORY ${target}
        PROPERTIES UNITY_GROUP "${key}_${group}")
      math(EXPR index "${index} + 1")
    endforeach()
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  # Seen from a group, an anonymous namespace seems to stand in a header.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endfunction()
