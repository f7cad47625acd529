# cmake -D GENERATOR=... -D COMMITTED=<Data> -D FRESH=<scratch folder> -P CompareDemoData.cmake
file(REMOVE_RECURSE "${FRESH}")
file(MAKE_DIRECTORY "${FRESH}")
execute_process(COMMAND "${GENERATOR}" "${FRESH}" COMMAND_ERROR_IS_FATAL ANY)
file(GLOB_RECURSE files RELATIVE "${FRESH}" "${FRESH}/*")
list(LENGTH files count)
if(count EQUAL 0)
  message(FATAL_ERROR "${GENERATOR} wrote nothing into ${FRESH}")
endif()
foreach(file IN LISTS files)
  execute_process(
    COMMAND "${CMAKE_COMMAND}" -E compare_files "${FRESH}/${file}" "${COMMITTED}/${file}"
    RESULT_VARIABLE differs)
  if(differs)
    message(SEND_ERROR "${COMMITTED}/${file} differs from what ${GENERATOR} writes")
  endif()
endforeach()
message(STATUS "compared ${count} files")
