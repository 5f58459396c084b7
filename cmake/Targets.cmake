# One library per folder of src/tunica/, one executable per driver, one per folder of unit tests.
# For our own compilations alone: whoever links a library has options of his own.
add_library(tunica_options INTERFACE)
target_compile_options(tunica_options INTERFACE -Wall -Wextra -Wshadow -Werror
  -fno-math-errno $<$<BOOL:${TUNICA_NATIVE}>:-march=native>)
target_include_directories(tunica_options INTERFACE ${PROJECT_SOURCE_DIR}/src)
# Since 14 Trilinos says in its own headers, by #warning, which of its packages will go.
if(Trilinos_VERSION VERSION_GREATER_EQUAL 14)
  target_compile_options(tunica_options INTERFACE -Wno-cpp -Wno-error=deprecated-declarations)
endif()

# Where it inlines the destructor of a vector of strings it warns of memory that nobody frees.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 15)
  target_compile_options(tunica_options INTERFACE -Wno-error=free-nonheap-object)
endif()

# tunica_library(fields SOURCES a.cpp b.cpp LINK base mesh trilinos PRIVATE_LINK nlohmann_json)
# LINK names our own folders and what cmake/TunicaDependencies.cmake finds, both without the prefix
# Tunica::. PRIVATE_LINK has headers only that no header of ours includes.
function(tunica_library name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINK;PRIVATE_LINK" ${ARGN})
  if(arg_SOURCES)
    add_library(tunica_${name} STATIC ${arg_SOURCES})
    set(scope PUBLIC)
    target_compile_options(tunica_${name} PRIVATE
      $<TARGET_PROPERTY:tunica_options,INTERFACE_COMPILE_OPTIONS>)
    if(TUNICA_C AND name IN_LIST TUNICA_C_FOLDERS)
      # What a shared library could replace at run time would not be inlined.
      set_target_properties(tunica_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
      target_compile_options(tunica_${name} PRIVATE -fno-semantic-interposition)
    endif()
  else()
    add_library(tunica_${name} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(Tunica::${name} ALIAS tunica_${name})
  target_compile_features(tunica_${name} ${scope} cxx_std_17)
  target_include_directories(tunica_${name} ${scope}
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  foreach(dependency IN LISTS arg_LINK)
    target_link_libraries(tunica_${name} ${scope} Tunica::${dependency})
  endforeach()
  foreach(dependency IN LISTS arg_PRIVATE_LINK)
    target_link_libraries(tunica_${name} PRIVATE $<BUILD_INTERFACE:${dependency}>)
  endforeach()
  tunica_install_library(${name})
endfunction()
