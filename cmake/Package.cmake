# cpack: a Debian package of all parts, programs, cases and meshes, tunica_VERSION_amd64.deb.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The Tunica developers")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
# The libraries that the programs are linked with; needs the package dpkg-dev.
find_program(DPKG_SHLIBDEPS dpkg-shlibdeps)
if(DPKG_SHLIBDEPS)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
endif()
set(CPACK_DEBIAN_PACKAGE_DEPENDS
  "openmpi-bin, python3, python3-h5py, python3-matplotlib, python3-numpy")
# For tunica-import, tunica-lumen, tunica-certify --smooth, and the tables of a beat of tunica-report.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS
  "python3-gmsh, python3-meshio, python3-scipy, python3-vtk9")
# For programs that link Tunica's libraries.
set(CPACK_DEBIAN_PACKAGE_SUGGESTS
  "cmake, g++, libhdf5-openmpi-dev, libmetis-dev, libmumps-dev, libopenmpi-dev, trilinos-all-dev")
include(CPack)
