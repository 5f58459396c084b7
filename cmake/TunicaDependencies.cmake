# What each part of Tunica needs of others, as imported targets. Our own build reads this, and
# installed it is read by TunicaConfig.cmake: both find the same. A macro that misses something says
# what in tunica_missing.

# Trilinos' packages under one name, Tunica::trilinos. Its own targets have no include folders before
# version 14.
macro(tunica_find_trilinos)
  find_package(MPI QUIET COMPONENTS CXX)
  find_package(Trilinos QUIET COMPONENTS ${ARGN})
  if(NOT MPI_CXX_FOUND)
    set(tunica_missing "MPI for C++ is missing (Debian: libopenmpi-dev).")
  elseif(NOT Trilinos_FOUND)
    set(tunica_missing "Trilinos with the packages ${ARGN} is missing (Debian: trilinos-all-dev).")
  else()
    if(NOT TARGET Tunica::trilinos)
      add_library(Tunica::trilinos INTERFACE IMPORTED)
    endif()
    if(TARGET Trilinos::all_selected_libs)
      set(tunica_trilinos_libraries Trilinos::all_selected_libs)
    else()
      set(tunica_trilinos_libraries ${Trilinos_LIBRARIES})
    endif()
    set_target_properties(Tunica::trilinos PROPERTIES
      INTERFACE_INCLUDE_DIRECTORIES "${Trilinos_INCLUDE_DIRS};${Trilinos_TPL_INCLUDE_DIRS}"
      INTERFACE_LINK_LIBRARIES "${tunica_trilinos_libraries};MPI::MPI_CXX")
  endif()
endmacro()

# tunica_find_library(metis metis.h METIS libmetis-dev FOLDER...): as Tunica::metis. The folders are
# below those where headers and libraries are.
macro(tunica_find_library name header prefix package)
  find_path(${prefix}_INCLUDE_DIR ${header} PATH_SUFFIXES ${ARGN})
  find_library(${prefix}_LIBRARY ${name} PATH_SUFFIXES ${ARGN})
  if(NOT ${prefix}_INCLUDE_DIR OR NOT ${prefix}_LIBRARY)
    set(tunica_missing "${prefix} is missing (Debian: ${package}).")
  elseif(NOT TARGET Tunica::${name})
    add_library(Tunica::${name} INTERFACE IMPORTED)
    set_target_properties(Tunica::${name} PROPERTIES
      INTERFACE_INCLUDE_DIRECTORIES "${${prefix}_INCLUDE_DIR}"
      INTERFACE_LINK_LIBRARIES "${${prefix}_LIBRARY}")
  endif()
endmacro()

macro(tunica_find_for_smoothers)
  tunica_find_trilinos(Tpetra Ifpack2 Amesos2 Teuchos)
endmacro()

macro(tunica_find_for_multigrid)
  tunica_find_trilinos(Tpetra MueLu Belos Ifpack2 Amesos2 Teuchos)
endmacro()

macro(tunica_find_for_fsi)
  tunica_find_trilinos(
    Tpetra NOX Teko MueLu Stratimikos Belos Ifpack2 Amesos2 Thyra Teuchos Sacado Zoltan2
    ShyLU_DDFROSch)
  tunica_find_library(metis metis.h METIS libmetis-dev)
  tunica_find_library(dmumps dmumps_c.h MUMPS libmumps-dev)
  # CMake's own search for HDF5 asks a compiler wrapper that fails on paths with spaces.
  tunica_find_library(hdf5 hdf5.h HDF5 libhdf5-openmpi-dev hdf5/openmpi)
  if(TARGET Tunica::hdf5 AND TARGET MPI::MPI_CXX)
    file(STRINGS ${HDF5_INCLUDE_DIR}/H5pubconf.h tunica_parallel REGEX "define H5_HAVE_PARALLEL 1")
    if(NOT tunica_parallel)
      set(tunica_missing "HDF5 is not parallel (Debian: libhdf5-openmpi-dev).")
    endif()
    set_property(TARGET Tunica::hdf5 PROPERTY
      INTERFACE_LINK_LIBRARIES ${HDF5_LIBRARY} MPI::MPI_CXX)
  endif()
endmacro()
