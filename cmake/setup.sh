# Common parts of ./quickstart and ./check, which read this file after they have set `root`.

# Open MPI refuses root and more ranks than cores unless it is told otherwise, makes system calls
# that containers forbid, and spins while it waits, which starves the others on a busy machine.
# One thread per rank.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_hwloc_base_binding_policy=none
export OMPI_MCA_btl_vader_single_copy_mechanism=none OMPI_MCA_mpi_yield_when_idle=1
export OMP_NUM_THREADS=1

program=$(basename "$0")
cores=$(env -u OMP_NUM_THREADS -u OMP_THREAD_LIMIT nproc)  # nproc would count the threads of OpenMP

stage() {
  printf '\n[%3d:%02d] %s\n' $((SECONDS / 60)) $((SECONDS % 60)) "$1"
}

fail() {
  printf '%s: %s\n' "$program" "$1" >&2
  exit 1
}

is_installed() {
  dpkg-query -W -f='${db:Status-Status}\n' "$1" 2>/dev/null | grep -qx installed
}

# ParaView brings a VTK of its own, and Debian would remove it for the other one.
missing_packages() {
  local package
  while read -r package; do
    is_installed "$package" || { [ "$package" = python3-vtk9 ] && is_installed python3-paraview; } ||
      echo "$package"
  done < cmake/apt-packages.txt
}

# apt_get WORDS...: as root, or through sudo where that asks for no password.
apt_get() {
  local as_root=()
  [ "$(id -u)" -eq 0 ] || as_root=(sudo -n)
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -y -qq "$@" </dev/null
}

install_packages() {
  stage "packages of cmake/apt-packages.txt"
  command -v dpkg-query >/dev/null ||
    fail "this is no Debian; install what cmake/apt-packages.txt names, then use cmake --preset release"
  local missing
  missing=$(missing_packages | tr '\n' ' ')
  missing=${missing% }
  if [ -z "$missing" ]; then
    echo "all installed"
    return
  fi
  if [ "$(id -u)" -ne 0 ] && ! sudo -n true 2>/dev/null; then
    echo "These packages are missing and need an administrator. Run this line, then $program again:"
    echo
    echo "sudo apt-get install -y --no-install-recommends $missing"
    exit 1
  fi
  echo "to install: $missing"
  apt_get update || fail "apt-get update failed; is there a network?"
  # shellcheck disable=SC2086  # a list of names
  apt_get install --no-install-recommends $missing || fail "apt-get install failed, see above"
}

# Memory that may be used, in kB: that of the machine, or of the container if that is less.
memory_kb() {
  local free limit=max
  free=$(awk '/^MemAvailable:/ {print $2}' /proc/meminfo)
  [ ! -r /sys/fs/cgroup/memory.max ] || limit=$(cat /sys/fs/cgroup/memory.max)
  if [ "$limit" != max ] && [ $((limit / 1024)) -lt "$free" ]; then
    free=$((limit / 1024))
  fi
  echo "$free"
}

# A compiler on Trilinos' headers takes up to 1.5 GB.
build_jobs() {
  local jobs
  jobs=$(($(memory_kb) / 1500000))
  [ "$jobs" -ge 1 ] || jobs=1
  [ "$jobs" -le "$cores" ] || jobs=$cores
  echo "$jobs"
}

# build TARGET...: what has been built before is not built again.
build() {
  local jobs
  jobs=$(build_jobs)
  stage "configuring"
  mkdir -p build
  cmake --preset release >build/configure.log 2>&1 || {
    cat build/configure.log
    fail "CMake failed, see above"
  }
  stage "building with $jobs job(s)"
  cmake --build --preset release -j "$jobs" --target "$@"
}
