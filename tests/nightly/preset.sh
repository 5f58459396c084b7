#!/bin/bash
# Builds a preset in build/PRESET and runs tests of it: with our own promises checked, and with those
# of memory under asan. Usage: preset.sh PRESET WORDS_FOR_CTEST...
set -euo pipefail
root=$(cd "$(dirname "$(readlink -f "$0")")/../.." && pwd)
cd "$root"
source cmake/setup.sh

preset=$1
shift
stage "configuring $preset"
cmake --preset "$preset"
stage "building with $(build_jobs) job(s)"
cmake --build --preset "$preset" -j "$(build_jobs)"
stage "tests"
ctest --preset "$preset" --parallel "$cores" --no-tests=error "$@" </dev/null
