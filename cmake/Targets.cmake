# One library per folder of src/tunica/, one executable per driver, one per folder of unit tests.
add_library(tunica_options INTERFACE)
target_compile_options(tunica_options INTERFACE -Wall -Wextra -Wshadow -Werror
  -fno-math-errno $<$<BOOL:${TUNICA_NATIVE}>:-march=native>)
target_include_directories(tunica_options INTERFACE ${PROJECT_SOURCE_DIR}/src)

# tunica_library(fields SOURCES a.cpp b.cpp LINK base mesh trilinos)
# Names of our own folders in LINK are given without their prefix.
function(tunica_library name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINK" ${ARGN})
  if(arg_SOURCES)
    add_library(tunica_${name} STATIC ${arg_SOURCES})
    set(scope PUBLIC)
  else()
    add_library(tunica_${name} INTERFACE)
    set(scope INTERFACE)
  endif()
  target_link_libraries(tunica_${name} ${scope} tunica_options)
  foreach(dependency IN LISTS arg_LINK)
    if(TARGET tunica_${dependency})
      set(dependency tunica_${dependency})
    endif()
    target_link_libraries(tunica_${name} ${scope} ${dependency})
  endforeach()
endfunction()

# Debian's KLU2 is miscompiled; the executable's own copy pre-empts the library's
# (see src/tunica/linear/klu2_repair.cpp). An object, not an archive: every executable must carry it.
function(tunica_repair_klu2 target)
  if(Trilinos_VERSION VERSION_LESS 15)
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:tunica_klu2_repair>)
  endif()
endfunction()
