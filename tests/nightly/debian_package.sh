#!/bin/bash
# The Debian package of a build, installed in a fresh Debian 12 with what it depends on and nothing
# else, runs the shipped pulse there; with the packages of a developer examples/fsi is built against
# it. Needs root, debootstrap and a mirror of Debian.
# Usage: debian_package.sh BUILD SCRATCH
set -euo pipefail
build=$1
scratch=$2
mirror=$(awk '/^URIs:/ {print $2; exit} /^deb / {print $2; exit}' \
  /etc/apt/sources.list.d/*.sources /etc/apt/sources.list 2>/dev/null || true)

if [ "$(id -u)" -ne 0 ] || ! command -v debootstrap >/dev/null; then
  echo "a root folder of Debian is made by root, with the package debootstrap"
  exit 1
fi
rm -rf "$scratch"
mkdir -p "$scratch"
cpack --config "$build/CPackConfig.cmake" -G DEB -B "$scratch/package"
debootstrap --variant=minbase bookworm "$scratch/root" "${mirror:-http://deb.debian.org/debian}"
cp "$scratch"/package/*.deb "$scratch/root/tmp/"
in_root() {
  chroot "$scratch/root" env DEBIAN_FRONTEND=noninteractive \
    OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMP_NUM_THREADS=1 "$@"
}
in_root apt-get -qq update
in_root sh -c 'apt-get install -y -qq --no-install-recommends /tmp/*.deb'
in_root tunica-fsi /usr/share/tunica/xml/pulse.xml --steps 2 --output /tmp/pulse
[ "$(wc -l < "$scratch/root/tmp/pulse/steps.csv")" -eq 3 ]
in_root tunica-fsi --help >/dev/null

in_root apt-get install -y -qq --no-install-recommends cmake g++ libhdf5-openmpi-dev libmetis-dev \
  libopenmpi-dev libptscotch-dev ninja-build nlohmann-json3-dev trilinos-all-dev
sources=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$build/CMakeCache.txt")
cp -r "$sources/examples/fsi" "$scratch/root/tmp/example"
in_root cmake -S /tmp/example -B /tmp/example/build -G Ninja
in_root cmake --build /tmp/example/build
in_root /tmp/example/build/fsi /tmp/example/case.xml /tmp/squeezed \
  "Mesh/file=/usr/share/tunica/meshes/tube-tiny.h5" > "$scratch/lines"
[ "$(grep -c ' mm$' "$scratch/lines")" -eq 8 ]
rm -rf "$scratch"
