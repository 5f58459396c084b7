#!/bin/bash
# Every find_package, find_library and find_program has its Debian package in cmake/apt-packages.txt.
set -euo pipefail

package_of() {
  case $1 in
    MPI) echo libopenmpi-dev ;;
    Trilinos) echo trilinos-all-dev ;;
    hdf5) echo libhdf5-openmpi-dev ;;
    metis) echo libmetis-dev ;;
    dmumps) echo libmumps-dev ;;
    dpkg-shlibdeps) echo dpkg-dev ;;
    doxygen) echo doxygen ;;
    nlohmann_json) echo nlohmann-json3-dev ;;
    benchmark) echo libbenchmark-dev ;;
    ccache | clang-format | clang-tidy) echo "$1" ;;
    *) echo "(unknown; name it in tests/house/package_list.sh)" ;;
  esac
}

wanted() {
  local files=(CMakeLists.txt cmake/*.cmake src/tunica/*/CMakeLists.txt drivers/CMakeLists.txt
    bench/CMakeLists.txt tests/house/CMakeLists.txt)
  sed -nE 's/.*find_package\((\w+).*/\1/p; s/.*tunica_find_library\((\w+) .*/\1/p
    s/.*find_program\(\w+ (NAMES )?([a-z-]+[a-z]).*/\2/p' "${files[@]}" | sort -u
}

status=0
for name in $(wanted); do
  package=$(package_of "$name")
  if ! grep -qxF "$package" cmake/apt-packages.txt; then
    echo "$name needs the package $package, which is not in cmake/apt-packages.txt"
    status=1
  fi
done
exit $status
