# Language level, warnings, sanitizers: one interface target that every target of ours links.
set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

add_library(MultispectralOptions INTERFACE)
target_compile_options(MultispectralOptions INTERFACE
  $<$<CXX_COMPILER_ID:GNU,Clang>:-Wall -Wextra -Wshadow -Wnon-virtual-dtor -Wold-style-cast
  -Wcast-qual -Woverloaded-virtual>
  # Clang's also counts what is written as a float times a double.
  $<$<CXX_COMPILER_ID:GNU>:-Wdouble-promotion>
  # The same expression gives the same bytes in every translation unit, thread and rank.
  $<$<CXX_COMPILER_ID:GNU,Clang>:-ffp-contract=off>)
if(MULTISPECTRAL_WERROR)
  target_compile_options(MultispectralOptions INTERFACE $<$<CXX_COMPILER_ID:GNU,Clang>:-Werror>)
endif()
if(MULTISPECTRAL_SANITIZE)
  # AddressSanitizer sees null pointers and overruns of objects too; checked twice they cost a quarter of the build.
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=undefined
    -fno-sanitize=null,object-size -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    # Eigen's own code is not ours to check for undefined behavior; half of what is instrumented would be Eigen's.
    set(ignored "${PROJECT_SOURCE_DIR}/CMake/sanitizer-ignored.txt")
    add_compile_options("-fsanitize-ignorelist=${ignored}")
  endif()
endif()
