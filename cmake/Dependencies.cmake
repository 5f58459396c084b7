# Everything comes from Debian's packages, listed in apt-packages.txt.
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()
find_program(CCACHE ccache)
if(CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
endif()

include(TunicaDependencies)
tunica_find_for_fsi()
if(tunica_missing)
  message(FATAL_ERROR ${tunica_missing})
endif()
find_package(nlohmann_json REQUIRED)  # in sources only
