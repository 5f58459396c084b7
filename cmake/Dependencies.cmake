# Everything comes from Debian's packages, listed in apt-packages.txt.
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()
find_program(CCACHE ccache)
if(CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
endif()

find_package(MPI REQUIRED COMPONENTS C CXX)
find_package(Trilinos REQUIRED COMPONENTS
  Tpetra NOX Teko MueLu Stratimikos Belos Ifpack2 Amesos2 Thyra Teuchos Sacado)
# CMake's own search for HDF5 asks a compiler wrapper that fails on paths with spaces.
find_path(HDF5_INCLUDE_DIR hdf5.h PATH_SUFFIXES hdf5/openmpi REQUIRED)
find_library(HDF5_LIBRARY hdf5 PATH_SUFFIXES hdf5/openmpi REQUIRED)
file(STRINGS ${HDF5_INCLUDE_DIR}/H5pubconf.h HDF5_PARALLEL_LINE REGEX "define H5_HAVE_PARALLEL 1")
if(NOT HDF5_PARALLEL_LINE)
  message(FATAL_ERROR "HDF5 is not parallel: install libhdf5-openmpi-dev")
endif()
find_path(METIS_INCLUDE_DIR metis.h REQUIRED)
find_library(METIS_LIBRARY metis REQUIRED)

add_library(trilinos INTERFACE)
target_include_directories(trilinos SYSTEM INTERFACE
  ${Trilinos_INCLUDE_DIRS} ${Trilinos_TPL_INCLUDE_DIRS})
if(TARGET Trilinos::all_selected_libs)
  target_link_libraries(trilinos INTERFACE Trilinos::all_selected_libs MPI::MPI_CXX)
else()
  target_link_libraries(trilinos INTERFACE ${Trilinos_LIBRARIES} MPI::MPI_CXX)
endif()

add_library(hdf5_parallel INTERFACE)
target_include_directories(hdf5_parallel SYSTEM INTERFACE ${HDF5_INCLUDE_DIR})
target_link_libraries(hdf5_parallel INTERFACE ${HDF5_LIBRARY} MPI::MPI_CXX)

add_library(metis INTERFACE)
target_include_directories(metis SYSTEM INTERFACE ${METIS_INCLUDE_DIR})
target_link_libraries(metis INTERFACE ${METIS_LIBRARY})
