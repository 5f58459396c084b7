# The parts that can be installed alone, each with those before it: smoothers, multigrid, fsi; and c,
# the shared library of the C interface.
# cmake/check_includes holds the folders of the first two to what they may include.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
if(NOT Trilinos_DIR MATCHES "^/usr/(lib|share)/")  # programs find one that is not the system's
  set(CMAKE_INSTALL_RPATH_USE_LINK_PATH ON)
endif()
set(TUNICA_SMOOTHERS_FOLDERS base algebra smoothers)
set(TUNICA_MULTIGRID_FOLDERS params multigrid)
# What the shared library of the C interface is made of.
set(TUNICA_C_FOLDERS base params io algebra smoothers multigrid linear systems foreign)
set(TUNICA_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/Tunica)
set(TUNICA_SHARE_DIR ${CMAKE_INSTALL_DATADIR}/tunica)

file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/public_headers.txt TUNICA_PUBLIC_HEADERS REGEX "^tunica/")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
  ${CMAKE_CURRENT_LIST_DIR}/public_headers.txt)

# The library of a folder and its public headers, as Tunica::FOLDER.
function(tunica_install_library name)
  set(part fsi)
  if(name IN_LIST TUNICA_SMOOTHERS_FOLDERS)
    set(part smoothers)
  elseif(name IN_LIST TUNICA_MULTIGRID_FOLDERS)
    set(part multigrid)
  endif()
  set_target_properties(tunica_${name} PROPERTIES EXPORT_NAME ${name})
  install(TARGETS tunica_${name} EXPORT Tunica-${part}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${part})
  foreach(header IN LISTS TUNICA_PUBLIC_HEADERS)
    if(header MATCHES "^tunica/${name}/")
      get_filename_component(folder ${header} DIRECTORY)
      install(FILES ${PROJECT_SOURCE_DIR}/src/${header}
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/${folder} COMPONENT ${part})
    endif()
  endforeach()
  if(part STREQUAL fsi)
    set_property(GLOBAL APPEND PROPERTY TUNICA_FSI_LIBRARIES tunica_${name})
  endif()
endfunction()

# What belongs to no folder; after all of them.
function(tunica_install_package)
  add_library(tunica_all INTERFACE)
  get_property(libraries GLOBAL PROPERTY TUNICA_FSI_LIBRARIES)
  add_library(Tunica::fsi ALIAS tunica_all)
  target_link_libraries(tunica_all INTERFACE ${libraries})
  set_target_properties(tunica_all PROPERTIES EXPORT_NAME fsi)
  install(TARGETS tunica_all EXPORT Tunica-fsi)
  set(parts smoothers multigrid fsi)
  if(TUNICA_C)
    list(APPEND parts c)
  endif()
  foreach(part IN LISTS parts)
    install(EXPORT Tunica-${part} NAMESPACE Tunica:: DESTINATION ${TUNICA_PACKAGE_DIR}
      COMPONENT ${part})
  endforeach()
  configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/TunicaConfig.cmake.in TunicaConfig.cmake
    INSTALL_DESTINATION ${TUNICA_PACKAGE_DIR} NO_CHECK_REQUIRED_COMPONENTS_MACRO)
  write_basic_package_version_file(TunicaConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  foreach(first smoothers c)  # what nothing comes before
    install(FILES ${PROJECT_SOURCE_DIR}/cmake/TunicaDependencies.cmake
      ${PROJECT_BINARY_DIR}/TunicaConfig.cmake ${PROJECT_BINARY_DIR}/TunicaConfigVersion.cmake
      DESTINATION ${TUNICA_PACKAGE_DIR} COMPONENT ${first})
    install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR}
      RENAME copyright COMPONENT ${first})
  endforeach()
  foreach(part multigrid c)
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples DESTINATION ${CMAKE_INSTALL_DOCDIR}
      COMPONENT ${part} PATTERN __pycache__ EXCLUDE)
  endforeach()
  tunica_install_before(multigrid smoothers)
  tunica_install_before(fsi multigrid)
endfunction()

# cmake --install knows no order of components: asked for one alone, it installs the one before.
function(tunica_install_before part before)
  install(CODE "execute_process(COMMAND \"${CMAKE_COMMAND}\" --install \"${PROJECT_BINARY_DIR}\"
    --prefix \"\${CMAKE_INSTALL_PREFIX}\" --config \"\${CMAKE_INSTALL_CONFIG_NAME}\"
    --component ${before} COMMAND_ERROR_IS_FATAL ANY)" COMPONENT ${part} EXCLUDE_FROM_ALL)
endfunction()

# Programs, those in Python, cases and meshes; cases find their meshes as they do in the source tree.
function(tunica_install_programs)
  install(TARGETS ${ARGN} DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT fsi)
  foreach(name adapt certify import lumen report vessel)
    install(PROGRAMS ${PROJECT_SOURCE_DIR}/drivers/tunica_${name}
      DESTINATION ${TUNICA_SHARE_DIR} COMPONENT fsi)
    # Python finds its modules behind the link, beside the program.
    file(RELATIVE_PATH target /${CMAKE_INSTALL_BINDIR} /${TUNICA_SHARE_DIR}/tunica_${name})
    file(CREATE_LINK ${target} ${PROJECT_BINARY_DIR}/tunica-${name} SYMBOLIC)
    install(FILES ${PROJECT_BINARY_DIR}/tunica-${name}
      DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT fsi)
  endforeach()
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/drivers/adapt ${PROJECT_SOURCE_DIR}/drivers/certify
    ${PROJECT_SOURCE_DIR}/drivers/importer ${PROJECT_SOURCE_DIR}/drivers/lumen
    ${PROJECT_SOURCE_DIR}/drivers/report ${PROJECT_SOURCE_DIR}/drivers/vessel
    ${PROJECT_SOURCE_DIR}/meshes ${PROJECT_SOURCE_DIR}/xml
    DESTINATION ${TUNICA_SHARE_DIR} COMPONENT fsi USE_SOURCE_PERMISSIONS
    PATTERN __pycache__ EXCLUDE PATTERN make.sh EXCLUDE)
  install(FILES ${PROJECT_SOURCE_DIR}/drivers/command_line.py DESTINATION ${TUNICA_SHARE_DIR} COMPONENT fsi)
  install(FILES ${PROJECT_SOURCE_DIR}/tests/data/mesh-tube-small.msh
    DESTINATION ${TUNICA_SHARE_DIR}/tests/data COMPONENT fsi)
endfunction()
